#pragma once

#include <functional>
#include <string_view>

#include "body_center/scan/accept_scan.h"
#include "body_center/store/body_store.h"

namespace fitroom::body_center {

// Ends an upload: reads it back from the store, checks size and hash of what is really held, accepts the scan and
// publishes it in one transaction. Memory: the file and what the acceptor needs.
// FAILED_PRECONDITION [UPLOAD_INCOMPLETE], CANCELLED and the store's own errors leave the upload as it is; DATA_LOSS
// [UPLOAD_HASH_MISMATCH] and a refusal by the acceptor drop it. Nothing is published unless the answer is OK.
Result<ScanRecord> FinishRegistration(BodyStore& store, const ScanAcceptor& acceptor, std::string_view upload_id,
                                      const std::function<bool()>& is_cancelled);

}  // namespace fitroom::body_center
