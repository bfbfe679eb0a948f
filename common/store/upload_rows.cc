#include "common/store/upload_rows.h"

#include <array>
#include <cstdio>
#include <ctime>
#include <random>

namespace fitroom::store {

using sqlite::Database;
using sqlite::Statement;

std::string NewUploadId() {
  std::random_device source;
  std::array<char, 33> text{};
  std::snprintf(text.data(), text.size(), "%08x%08x%08x%08x", source(), source(), source(), source());
  return text.data();
}

Status UploadNotFound() {
  return NotFound("UPLOAD_NOT_FOUND", "no such upload: it is finished, cancelled or dropped; start it again");
}

Status UploadIncomplete() {
  return FailedPrecondition("UPLOAD_INCOMPLETE", "bytes are missing; ask how far the upload is and go on from there");
}

Status UploadTooLong() {
  return Status(StatusCode::kOutOfRange, "UPLOAD_TOO_LONG", "more bytes than were stated at the start");
}

Status TouchUpload(Database& database, std::string_view id) {
  FR_ASSIGN_OR_RETURN(Statement touch, database.Prepare("UPDATE uploads SET touch_time_unix_s = ?1 WHERE upload = ?2"));
  return touch.Bind(1, int64_t{std::time(nullptr)}).Bind(2, id).Run();
}

Status DeleteUploadRow(Database& database, std::string_view id) {
  FR_ASSIGN_OR_RETURN(Statement remove, database.Prepare("DELETE FROM uploads WHERE upload = ?1"));
  return remove.Bind(1, id).Run();
}

Result<std::vector<std::string>> StaleUploads(Database& database, int64_t unix_s) {
  FR_ASSIGN_OR_RETURN(Statement select, database.Prepare("SELECT upload FROM uploads WHERE touch_time_unix_s < ?1"));
  select.Bind(1, unix_s);
  std::vector<std::string> ids;
  for (;;) {
    FR_ASSIGN_OR_RETURN(const bool has_row, select.Step());
    if (!has_row) return ids;
    ids.push_back(select.Text(0));
  }
}

}  // namespace fitroom::store
