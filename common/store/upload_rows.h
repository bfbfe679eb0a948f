#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "common/sqlite/database.h"

// The rows of uploads under way: a table `uploads` with the columns `upload` and `touch_time_unix_s`, beside those that
// a program adds.
namespace fitroom::store {

// Returns an id that nobody can guess: 128 random bits, in hexadecimal.
std::string NewUploadId();

Status UploadNotFound();    // NOT_FOUND [UPLOAD_NOT_FOUND].
Status UploadIncomplete();  // FAILED_PRECONDITION [UPLOAD_INCOMPLETE].
Status UploadTooLong();     // OUT_OF_RANGE [UPLOAD_TOO_LONG].

// Notes that an upload got bytes just now.
Status TouchUpload(sqlite::Database& database, std::string_view id);
// Deletes the row; blobs are the caller's.
Status DeleteUploadRow(sqlite::Database& database, std::string_view id);
// Returns the ids of uploads that got their last bytes before `unix_s`.
Result<std::vector<std::string>> StaleUploads(sqlite::Database& database, int64_t unix_s);

}  // namespace fitroom::store
