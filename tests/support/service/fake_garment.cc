#include "tests/support/service/fake_garment.h"

#include <random>

#include "tests/support/sample_garment.h"

namespace fitroom::testing {
namespace {

constexpr std::string_view kMark = "FAKE PHOTO\n";

void AddFiles(const GarmentView& view, std::string_view photo, std::vector<GarmentFile>& files) {
  files.push_back({view.photo_file, std::string(photo)});
  files.push_back({view.mask_file, "mask of " + std::string(photo.substr(0, 40))});
  files.push_back({view.texture_file, "texture of " + std::string(photo)});
}

}  // namespace

std::string FakePhoto(uint32_t seed, size_t size) {
  std::mt19937 random(seed);
  std::string photo(kMark);
  while (photo.size() < size) photo += static_cast<char>(random());
  photo.resize(size);
  return photo;
}

GarmentUploadStatement GarmentStatementOf(const std::string& id, const std::string& front, const std::string& back) {
  GarmentUploadStatement statement;
  statement.id = id;
  statement.title = "Garment " + id;
  statement.length = 0.68;
  statement.photos.push_back({GarmentSide::kFront, std::ssize(front), Blake2b(front)});
  if (!back.empty()) statement.photos.push_back({GarmentSide::kBack, std::ssize(back), Blake2b(back)});
  return statement;
}

GarmentUploadStatement TrouserStatementOf(const std::string& id, const std::vector<std::string_view>& photos) {
  const Garment trousers = MakeSampleTrousers();
  GarmentUploadStatement statement;
  statement.id = id;
  statement.title = "Trousers " + id;
  statement.kind = GarmentKind::kPants;
  statement.length = 1.0;
  for (size_t i = 0; i < photos.size(); ++i) {
    statement.photos.push_back({static_cast<GarmentSide>(i), std::ssize(photos[i]), Blake2b(photos[i])});
  }
  statement.stated = {trousers.fabric, trousers.chart, {*FindMeasure(trousers.measures, "front_rise")}};
  return statement;
}

Result<shop_catalog::GarmentExtraction> FakeExtractor(const shop_catalog::ExtractionRequest& request) {
  if (!request.front_photo.starts_with(kMark)) {
    return FailedPrecondition("NO_GARMENT_FOUND", "front: no garment was found; photograph it on a plain ground");
  }
  shop_catalog::GarmentExtraction extraction;
  Garment& garment = extraction.garment;
  garment = request.kind == GarmentKind::kPants ? MakeSampleTrousers() : MakeSampleTShirt();
  // What a shop states is not on photographs.
  garment.fabric = Garment().fabric;
  garment.chart = {};
  std::erase_if(garment.measures, [](const auto& measure) { return measure.provenance == Provenance::kStated; });
  garment.id = request.id;
  garment.title = request.title;
  garment.length = request.length;
  AddFiles(garment.front, request.front_photo, extraction.files);
  if (request.back_photo.empty()) {
    garment.back.reset();
  } else {
    AddFiles(*garment.back, request.back_photo, extraction.files);
  }
  if (request.side_folded_photo.empty()) {
    garment.side_folded.reset();
  } else {
    AddFiles(*garment.side_folded, request.side_folded_photo, extraction.files);
  }
  extraction.files.push_back({"extraction.png", "drawing"});
  return extraction;
}

}  // namespace fitroom::testing
