#pragma once

#include "common/scan_record/scan_record.h"
#include "fitroom/body/v1/scan.pb.h"
#include "fitroom/body/v1/scan_service.pb.h"

// The one place where the body center's domain types and messages turn into each other. Reading checks: a message
// comes from outside. Errors are INVALID_ARGUMENT with the field in the message.
namespace fitroom::remote {

void ToProto(const ScanRecord& scan, body::v1::Scan& message);
Result<ScanRecord> ScanRecordFromProto(const body::v1::Scan& message);

void ToProto(const ScanUploadStatement& statement, body::v1::StartScanUploadRequest& message);
Result<ScanUploadStatement> StatementFromProto(const body::v1::StartScanUploadRequest& message);

void ToProto(const ScanUpload& upload, body::v1::ScanUpload& message);
// Fills what the message holds: id, scan name, stated size and committed size.
Result<ScanUpload> UploadFromProto(const body::v1::ScanUpload& message);

// `bodies/{body}/uploads/{upload}` and back.
struct UploadRef {
  std::string body;
  std::string id;
};
std::string UploadName(const ScanUpload& upload);
Result<UploadRef> UploadRefFromName(std::string_view name);

body::v1::ScanContent ToProto(ScanContent content);
Result<ScanContent> ContentFromProto(body::v1::ScanContent content);

}  // namespace fitroom::remote
