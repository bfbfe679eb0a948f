#pragma once

#include "common/garment_record/garment_record.h"
#include "fitroom/shop/v1/garment.pb.h"
#include "fitroom/shop/v1/garment_service.pb.h"

// The one place where the shop's domain types and messages turn into each other. Reading checks: a message comes from
// outside. Errors are INVALID_ARGUMENT with the field in the message.
namespace fitroom::remote {

void ToProto(const GarmentRecord& record, shop::v1::Garment& message);
// Checks names, numbers and sizes; whether outline and points fit together is ValidateGarment()'s to say.
Result<GarmentRecord> GarmentRecordFromProto(const shop::v1::Garment& message);

void ToProto(const GarmentUploadStatement& statement, shop::v1::StartGarmentUploadRequest& message);
// Checks all that can be checked without the photographs; also the errors of ValidateShopStatement().
Result<GarmentUploadStatement> StatementFromProto(const shop::v1::StartGarmentUploadRequest& message);

void ToProto(const GarmentUpload& upload, shop::v1::GarmentUpload& message);
// Fills id and, for each photograph of `statement`, its committed size.
Result<GarmentUpload> UploadFromProto(const shop::v1::GarmentUpload& message, const GarmentUploadStatement& statement);

// `garments/{garment}` and back.
std::string GarmentName(std::string_view id);
Result<std::string> GarmentIdFromName(std::string_view name);
// `uploads/{upload}` and back.
std::string UploadName(const GarmentUpload& upload);
Result<std::string> UploadIdFromShopName(std::string_view name);
// `garments/{garment}/images/{image}` and back.
struct ImageName {
  std::string garment;
  std::string image;
};
std::string ToString(const ImageName& name);
Result<ImageName> ImageNameFrom(std::string_view name);

shop::v1::GarmentSide ToProto(GarmentSide side);
Result<GarmentSide> SideFromProto(shop::v1::GarmentSide side);

}  // namespace fitroom::remote
