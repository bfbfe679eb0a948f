#include "fit_client/remote/pull_garment.h"

#include <set>

#include "common/base/file.h"
#include "common/garment/garment_json.h"
#include "common/garment/validate.h"
#include "fit_client/cache/cache.h"
#include "fit_client/remote/pull_lock.h"
#include "fit_client/remote/resumed_file.h"

namespace fitroom::fit_client {
namespace {

namespace fs = std::filesystem;

bool IsCached(const fs::path& folder, const GarmentRecord& record) {
  const Result<std::string> json = ReadFile(folder / "garment.json", size_t{4} << 20);
  if (!json.ok() || *json != GarmentToJson(record.garment)) return false;
  for (const GarmentImageRecord& image : record.images) {
    const Result<MappedFile> file = MappedFile::Open(folder / image.file_name);
    if (!file.ok() || Blake2b(file->text()) != image.hash) return false;
  }
  return true;
}

// Checks what a shop says before anything of it touches the disk: every file once, no view without its files.
Status CheckRecord(const GarmentRecord& record) {
  FR_RETURN_IF_ERROR(ValidateGarment(record.garment));
  std::set<std::string> names = {"garment.json"};
  for (const GarmentImageRecord& image : record.images) {
    if (!names.insert(image.file_name).second) {
      return InvalidArgument("GARMENT_FILE_NAME", "the shop names a file twice: " + image.file_name);
    }
  }
  const auto has_files = [&names](const GarmentView& view) {
    return names.contains(view.photo_file) && names.contains(view.mask_file) && names.contains(view.texture_file);
  };
  const Garment& garment = record.garment;
  if (!has_files(garment.front) || (garment.back && !has_files(*garment.back)) ||
      (garment.side_folded && !has_files(*garment.side_folded))) {
    return InvalidArgument("GARMENT_FILE_MISSING", "the shop does not offer all images of the garment");
  }
  return Status();
}

}  // namespace

Result<GarmentRecord> PullGarment(remote::ShopClient& client, const fs::path& cache, std::string_view name,
                                  const ProgressSink& progress) {
  FR_ASSIGN_OR_RETURN(const std::string id, GarmentIdFromUser(name));
  FR_ASSIGN_OR_RETURN(GarmentRecord record, client.GetGarment(id));
  if (record.garment.id != id) {
    return DataLoss("GARMENT_NAME_MISMATCH",
                    "the shop answered with garments/" + record.garment.id + "; pull it again");
  }
  FR_RETURN_IF_ERROR(CheckRecord(record));
  const fs::path folder = GarmentFolder(cache, id);
  FR_RETURN_IF_ERROR(MakePrivateFolder(cache));
  FR_RETURN_IF_ERROR(MakePrivateFolder(folder.parent_path()));
  // Whoever waits here finds the garment cached afterwards.
  FR_ASSIGN_OR_RETURN(const PullLock lock, PullLock::Take(folder.parent_path() / (".lock-" + id), kPullPatience));
  if (IsCached(folder, record)) return record;
  const std::string json = GarmentToJson(record.garment);
  const fs::path partial = folder.parent_path() / (".partial-" + id + "-" + Blake2b(json).ToHex().substr(0, 16));
  FR_RETURN_IF_ERROR(MakePrivateFolder(partial));
  for (const GarmentImageRecord& image : record.images) {
    FR_RETURN_IF_ERROR(DownloadResumed(
        partial / image.file_name, image.size, image.hash,
        [&](int64_t offset, const std::function<Status(std::string_view)>& sink) {
          return client.DownloadImage(id, ImageId(image.kind, image.side), offset, sink);
        },
        progress));
  }
  FR_RETURN_IF_ERROR(WriteFileAtomically(partial / "garment.json", json));
  FR_RETURN_IF_ERROR(ReplaceFolder(partial, folder));
  return record;
}

}  // namespace fitroom::fit_client
