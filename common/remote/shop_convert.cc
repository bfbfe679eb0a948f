#include "common/remote/shop_convert.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "common/base/resource_name.h"
#include "common/garment/validate.h"

namespace fitroom::remote {
namespace {

constexpr size_t kMaxTitleSize = 200;                 // (unit: byte)
constexpr int64_t kMaxImageSize = int64_t{64} << 20;  // (unit: byte)

Status FieldInvalid(std::string_view field, std::string_view rule) {
  return InvalidArgument("FIELD_INVALID", std::string(field) + ": " + std::string(rule));
}

// Takes the one id behind `prefix`.
std::optional<std::string> IdBehind(std::string_view prefix, std::string_view name) {
  if (!name.starts_with(prefix) || !IsResourceId(name.substr(prefix.size()))) return std::nullopt;
  return std::string(name.substr(prefix.size()));
}

Result<Hash256> HashFromProto(const std::string& bytes) {
  const std::optional<Hash256> hash = Hash256::FromBytes(bytes);
  if (!hash) return FieldInvalid("blake2b_256", "expected 32 bytes");
  return *hash;
}

// The order of kinds is the same on both sides; the first is 1 on the wire.
shop::v1::GarmentKind KindToProto(GarmentKind kind) {
  return static_cast<shop::v1::GarmentKind>(static_cast<int>(kind) + 1);
}
static_assert(static_cast<int>(GarmentKind::kTShirt) + 1 == shop::v1::GARMENT_KIND_TSHIRT);
static_assert(static_cast<int>(GarmentKind::kLongSleeve) + 1 == shop::v1::GARMENT_KIND_LONG_SLEEVE);
static_assert(static_cast<int>(GarmentKind::kOnePiece) + 1 == shop::v1::GARMENT_KIND_ONE_PIECE);
static_assert(static_cast<int>(GarmentKind::kSkirt) + 1 == shop::v1::GARMENT_KIND_SKIRT);
static_assert(static_cast<int>(GarmentKind::kPants) + 1 == shop::v1::GARMENT_KIND_PANTS);
static_assert(static_cast<int>(GarmentKind::kShorts) + 1 == shop::v1::GARMENT_KIND_SHORTS);
static_assert(static_cast<int>(GarmentKind::kSleevedOnePiece) + 1 == shop::v1::GARMENT_KIND_ONE_PIECE_SLEEVED);
static_assert(static_cast<int>(GarmentImageKind::kPhoto) + 1 == shop::v1::IMAGE_KIND_PHOTO);
static_assert(static_cast<int>(GarmentImageKind::kMask) + 1 == shop::v1::IMAGE_KIND_MASK);
static_assert(static_cast<int>(GarmentImageKind::kTexture) + 1 == shop::v1::IMAGE_KIND_TEXTURE);
static_assert(static_cast<int>(GarmentImageKind::kExtraction) + 1 == shop::v1::IMAGE_KIND_EXTRACTION);

static_assert(static_cast<int>(GarmentSide::kFront) + 1 == shop::v1::GARMENT_SIDE_FRONT);
static_assert(static_cast<int>(GarmentSide::kBack) + 1 == shop::v1::GARMENT_SIDE_BACK);
static_assert(static_cast<int>(GarmentSide::kSideFolded) + 1 == shop::v1::GARMENT_SIDE_SIDE_FOLDED);
static_assert(static_cast<int>(Provenance::kMeasured) + 1 == shop::v1::MEASURE_PROVENANCE_MEASURED);
static_assert(static_cast<int>(Provenance::kStated) + 1 == shop::v1::MEASURE_PROVENANCE_STATED);
static_assert(static_cast<int>(Provenance::kRuled) + 1 == shop::v1::MEASURE_PROVENANCE_RULED);
static_assert(static_cast<int>(Provenance::kUnknown) + 1 == shop::v1::MEASURE_PROVENANCE_UNKNOWN);

// In the order of shop::v1::Fabric, whose first is 1.
constexpr std::array<std::string_view, 4> kFabrics = {"jersey", "woven", "denim", "stretch"};
static_assert(shop::v1::Fabric_MAX == kFabrics.size());

shop::v1::Fabric FabricToProto(std::string_view fabric) {
  const auto place = std::find(kFabrics.begin(), kFabrics.end(), fabric);
  if (place == kFabrics.end()) return shop::v1::FABRIC_UNSPECIFIED;
  return static_cast<shop::v1::Fabric>(place - kFabrics.begin() + 1);
}

Result<std::string> FabricFromProto(shop::v1::Fabric fabric) {
  if (fabric == shop::v1::FABRIC_UNSPECIFIED) return std::string(kFabrics[0]);
  if (fabric < 1 || fabric > shop::v1::Fabric_MAX)
    return FieldInvalid("fabric", "not a fabric that this program knows");
  return std::string(kFabrics[static_cast<size_t>(fabric) - 1]);
}

using MeasureMessages = google::protobuf::RepeatedPtrField<shop::v1::GarmentMeasure>;

void MeasuresToProto(const std::vector<GarmentMeasure>& measures, MeasureMessages& messages) {
  for (const GarmentMeasure& measure : measures) {
    shop::v1::GarmentMeasure* added = messages.Add();
    added->set_measure(measure.name);
    added->set_length_m(measure.value);
    added->set_provenance(static_cast<shop::v1::MeasureProvenance>(static_cast<int>(measure.provenance) + 1));
  }
}

// What a shop states is whole tenths of a millimetre, so that every way to write it down gives the same number.
std::vector<GarmentMeasure> StatedFromProto(const MeasureMessages& messages) {
  std::vector<GarmentMeasure> measures;
  for (const shop::v1::GarmentMeasure& message : messages) {
    measures.push_back({message.measure(), std::round(message.length_m() * 1e4) / 1e4, Provenance::kStated});
  }
  return measures;
}

Result<std::vector<GarmentMeasure>> MeasuresFromProto(const MeasureMessages& messages) {
  std::vector<GarmentMeasure> measures;
  for (const shop::v1::GarmentMeasure& message : messages) {
    if (message.provenance() < 0 || message.provenance() > shop::v1::MeasureProvenance_MAX) {
      return FieldInvalid("measures.provenance", "not a provenance that this program knows");
    }
    const int provenance = std::max(static_cast<int>(message.provenance()), 1) - 1;
    measures.push_back({message.measure(), message.length_m(), static_cast<Provenance>(provenance)});
  }
  return measures;
}

void ChartToProto(const SizeChart& chart, shop::v1::SizeChart& message) {
  message.set_photographed_size(chart.photographed_size);
  for (const GarmentSize& size : chart.sizes) {
    shop::v1::GarmentSize* added = message.add_sizes();
    added->set_size(size.name);
    MeasuresToProto(size.measures, *added->mutable_measures());
    MeasuresToProto(size.body, *added->mutable_cut_for());
  }
}

SizeChart ChartFromProto(const shop::v1::SizeChart& message) {
  SizeChart chart;
  chart.photographed_size = message.photographed_size();
  for (const shop::v1::GarmentSize& size : message.sizes()) {
    chart.sizes.push_back({size.size(), StatedFromProto(size.measures()), StatedFromProto(size.cut_for())});
  }
  return chart;
}

Result<GarmentKind> KindFromProto(shop::v1::GarmentKind kind) {
  if (kind < shop::v1::GARMENT_KIND_TSHIRT || kind > shop::v1::GARMENT_KIND_ONE_PIECE_SLEEVED) {
    return FieldInvalid("kind", "not a kind that this program knows");
  }
  return static_cast<GarmentKind>(static_cast<int>(kind) - 1);
}

void ViewToProto(const GarmentView& view, shop::v1::GarmentView& message) {
  message.set_side(ToProto(view.side));
  message.set_image_width_px(view.image_width);
  message.set_image_height_px(view.image_height);
  message.set_metre_per_pixel(view.metre_per_pixel);
  for (const Eigen::Vector2d& corner : view.outline) {
    message.add_outline_xy_px(corner.x());
    message.add_outline_xy_px(corner.y());
  }
  for (const OutlinePoint& point : view.points) {
    shop::v1::OutlinePoint* added = message.add_points();
    added->set_point(point.name);
    added->set_x_px(point.pixel.x());
    added->set_y_px(point.pixel.y());
    added->set_confidence(point.confidence);
  }
}

Result<GarmentView> ViewFromProto(const shop::v1::GarmentView& message) {
  GarmentView view;
  FR_ASSIGN_OR_RETURN(view.side, SideFromProto(message.side()));
  view.image_width = message.image_width_px();
  view.image_height = message.image_height_px();
  view.metre_per_pixel = message.metre_per_pixel();
  const auto& outline = message.outline_xy_px();
  if (outline.size() % 2 != 0 || outline.size() > 2 * kMaxOutlinePoints) {
    return FieldInvalid("outline_xy_px", "expected pairs, at most 5000");
  }
  for (int i = 0; i < outline.size(); i += 2) view.outline.emplace_back(outline.Get(i), outline.Get(i + 1));
  for (const shop::v1::OutlinePoint& point : message.points()) {
    view.points.push_back({point.point(), {point.x_px(), point.y_px()}, point.confidence()});
  }
  return view;
}

Result<GarmentImageRecord> ImageFromProto(const shop::v1::GarmentImage& message) {
  GarmentImageRecord image;
  if (message.kind() < shop::v1::IMAGE_KIND_PHOTO || message.kind() > shop::v1::IMAGE_KIND_EXTRACTION) {
    return FieldInvalid("images.kind", "not a kind that this program knows");
  }
  image.kind = static_cast<GarmentImageKind>(static_cast<int>(message.kind()) - 1);
  FR_ASSIGN_OR_RETURN(image.side, SideFromProto(message.side()));
  if (!IsPlainFileName(message.file_name())) return FieldInvalid("images.file_name", "not a plain file name");
  image.file_name = message.file_name();
  if (message.size_bytes() < 1 || message.size_bytes() > kMaxImageSize) {
    return FieldInvalid("images.size_bytes", "expected 1 to 67108864");
  }
  image.size = message.size_bytes();
  FR_ASSIGN_OR_RETURN(image.hash, HashFromProto(message.blake2b_256()));
  return image;
}

// Puts the file names of the images into the views that they belong to.
void NameFiles(const std::vector<GarmentImageRecord>& images, GarmentView& view) {
  for (const GarmentImageRecord& image : images) {
    if (image.side != view.side) continue;
    if (image.kind == GarmentImageKind::kPhoto) view.photo_file = image.file_name;
    if (image.kind == GarmentImageKind::kMask) view.mask_file = image.file_name;
    if (image.kind == GarmentImageKind::kTexture) view.texture_file = image.file_name;
  }
}

}  // namespace

std::string GarmentName(std::string_view id) { return "garments/" + std::string(id); }

Result<std::string> GarmentIdFromName(std::string_view name) {
  if (std::optional<std::string> id = IdBehind("garments/", name)) return *std::move(id);
  return InvalidArgument("GARMENT_NAME_INVALID",
                         "a garment's name is garments/GARMENT, its id 1 to 63 of a-z, 0-9 and -");
}

std::string UploadName(const GarmentUpload& upload) { return "uploads/" + upload.id; }

Result<std::string> UploadIdFromShopName(std::string_view name) {
  if (std::optional<std::string> id = IdBehind("uploads/", name)) return *std::move(id);
  return InvalidArgument("UPLOAD_NAME_INVALID", "an upload's name is uploads/UPLOAD");
}

std::string ToString(const ImageName& name) { return GarmentName(name.garment) + "/images/" + name.image; }

Result<ImageName> ImageNameFrom(std::string_view name) {
  constexpr std::string_view kImages = "/images/";
  const size_t middle = name.find(kImages);
  if (middle != std::string_view::npos) {
    const Result<std::string> garment = GarmentIdFromName(name.substr(0, middle));
    const std::string_view image = name.substr(middle + kImages.size());
    if (garment.ok() && IsResourceId(image)) return ImageName{*garment, std::string(image)};
  }
  return InvalidArgument("IMAGE_NAME_INVALID", "an image's name is garments/GARMENT/images/IMAGE");
}

shop::v1::GarmentSide ToProto(GarmentSide side) {
  return static_cast<shop::v1::GarmentSide>(static_cast<int>(side) + 1);
}

Result<GarmentSide> SideFromProto(shop::v1::GarmentSide side) {
  if (side < shop::v1::GARMENT_SIDE_FRONT || side > shop::v1::GARMENT_SIDE_SIDE_FOLDED) {
    return FieldInvalid("side", "expected GARMENT_SIDE_FRONT, GARMENT_SIDE_BACK or GARMENT_SIDE_SIDE_FOLDED");
  }
  return static_cast<GarmentSide>(static_cast<int>(side) - 1);
}

void ToProto(const GarmentRecord& record, shop::v1::Garment& message) {
  const Garment& garment = record.garment;
  message.set_name(GarmentName(garment.id));
  message.set_title(garment.title);
  message.set_kind(KindToProto(garment.kind));
  message.set_length_m(garment.length);
  ViewToProto(garment.front, *message.add_views());
  if (garment.back) ViewToProto(*garment.back, *message.add_views());
  if (garment.side_folded) ViewToProto(*garment.side_folded, *message.add_views());
  for (const GarmentImageRecord& image : record.images) {
    shop::v1::GarmentImage* added = message.add_images();
    added->set_name(ToString(ImageName{garment.id, ImageId(image.kind, image.side)}));
    added->set_kind(static_cast<shop::v1::ImageKind>(static_cast<int>(image.kind) + 1));
    added->set_side(ToProto(image.side));
    added->set_size_bytes(image.size);
    added->set_blake2b_256(std::string(image.hash.view()));
    added->set_file_name(image.file_name);
  }
  message.mutable_publish_time()->set_seconds(record.publish_time_unix_s);
  MeasuresToProto(garment.measures, *message.mutable_measures());
  message.set_fabric(FabricToProto(garment.fabric));
  if (!garment.chart.sizes.empty()) ChartToProto(garment.chart, *message.mutable_chart());
}

Result<GarmentRecord> GarmentRecordFromProto(const shop::v1::Garment& message) {
  GarmentRecord record;
  Garment& garment = record.garment;
  FR_ASSIGN_OR_RETURN(garment.id, GarmentIdFromName(message.name()));
  garment.title = message.title();
  FR_ASSIGN_OR_RETURN(garment.kind, KindFromProto(message.kind()));
  garment.length = message.length_m();
  for (const shop::v1::GarmentImage& image : message.images()) {
    FR_ASSIGN_OR_RETURN(GarmentImageRecord known, ImageFromProto(image));
    record.images.push_back(std::move(known));
  }
  bool has_front = false;
  for (const shop::v1::GarmentView& view : message.views()) {
    FR_ASSIGN_OR_RETURN(GarmentView known, ViewFromProto(view));
    NameFiles(record.images, known);
    if (known.side == GarmentSide::kFront) {
      garment.front = std::move(known);
      has_front = true;
    } else {
      (known.side == GarmentSide::kBack ? garment.back : garment.side_folded) = std::move(known);
    }
  }
  if (!has_front) return FieldInvalid("views", "the front is missing");
  FR_ASSIGN_OR_RETURN(garment.measures, MeasuresFromProto(message.measures()));
  FR_ASSIGN_OR_RETURN(garment.fabric, FabricFromProto(message.fabric()));
  garment.chart = ChartFromProto(message.chart());
  record.publish_time_unix_s = message.publish_time().seconds();
  return record;
}

void ToProto(const GarmentUploadStatement& statement, shop::v1::StartGarmentUploadRequest& message) {
  message.set_name(GarmentName(statement.id));
  message.set_title(statement.title);
  message.set_kind(KindToProto(statement.kind));
  message.set_length_m(statement.length);
  for (const PhotoStatement& photo : statement.photos) {
    shop::v1::PhotoSpec* added = message.add_photos();
    added->set_side(ToProto(photo.side));
    added->set_size_bytes(photo.size);
    added->set_blake2b_256(std::string(photo.hash.view()));
  }
  message.set_annotation_json(statement.annotation_json);
  message.set_fabric(FabricToProto(statement.stated.fabric));
  MeasuresToProto(statement.stated.measures, *message.mutable_stated_measures());
  if (!statement.stated.chart.sizes.empty()) ChartToProto(statement.stated.chart, *message.mutable_chart());
}

Result<GarmentUploadStatement> StatementFromProto(const shop::v1::StartGarmentUploadRequest& message) {
  GarmentUploadStatement statement;
  FR_ASSIGN_OR_RETURN(statement.id, GarmentIdFromName(message.name()));
  if (message.title().empty() || message.title().size() > kMaxTitleSize) {
    return FieldInvalid("title", "expected 1 to 200 bytes");
  }
  statement.title = message.title();
  FR_ASSIGN_OR_RETURN(statement.kind, KindFromProto(message.kind()));
  if (!(message.length_m() >= 0.1 && message.length_m() <= 2.0)) {
    return FieldInvalid("length_m", "state the garment's length, 0.1 to 2 m (10 to 200 cm)");
  }
  statement.length = message.length_m();
  for (const shop::v1::PhotoSpec& photo : message.photos()) {
    PhotoStatement known;
    FR_ASSIGN_OR_RETURN(known.side, SideFromProto(photo.side()));
    if (FindPhoto(statement, known.side)) return FieldInvalid("photos", "a side is stated twice");
    if (photo.size_bytes() < 1 || photo.size_bytes() > kMaxPhotoSize) {
      return FieldInvalid("photos.size_bytes", "a photograph has 1 to 20971520 bytes (20 MiB)");
    }
    known.size = photo.size_bytes();
    FR_ASSIGN_OR_RETURN(known.hash, HashFromProto(photo.blake2b_256()));
    statement.photos.push_back(known);
  }
  if (FindPhoto(statement, GarmentSide::kSideFolded) && !HasLegs(statement.kind)) {
    return FieldInvalid("photos", "a side-folded photograph belongs to pants and shorts alone");
  }
  if (!FindPhoto(statement, GarmentSide::kFront)) return FieldInvalid("photos", "the front is missing");
  if (message.annotation_json().size() > kMaxAnnotationSize) {
    return FieldInvalid("annotation_json", "longer than 262144 bytes");
  }
  statement.annotation_json = message.annotation_json();
  FR_ASSIGN_OR_RETURN(statement.stated.fabric, FabricFromProto(message.fabric()));
  statement.stated.measures = StatedFromProto(message.stated_measures());
  statement.stated.chart = ChartFromProto(message.chart());
  FR_RETURN_IF_ERROR(ValidateShopStatement(statement.kind, statement.stated));
  return statement;
}

void ToProto(const GarmentUpload& upload, shop::v1::GarmentUpload& message) {
  message.set_name(UploadName(upload));
  message.set_garment(GarmentName(upload.statement.id));
  for (size_t i = 0; i < upload.statement.photos.size(); ++i) {
    shop::v1::PhotoProgress* photo = message.add_photos();
    photo->set_side(ToProto(upload.statement.photos[i].side));
    photo->set_committed_size_bytes(upload.committed_sizes[i]);
  }
}

Result<GarmentUpload> UploadFromProto(const shop::v1::GarmentUpload& message, const GarmentUploadStatement& statement) {
  GarmentUpload upload;
  FR_ASSIGN_OR_RETURN(upload.id, UploadIdFromShopName(message.name()));
  upload.statement = statement;
  upload.committed_sizes.resize(statement.photos.size());
  for (const shop::v1::PhotoProgress& photo : message.photos()) {
    FR_ASSIGN_OR_RETURN(const GarmentSide side, SideFromProto(photo.side()));
    const std::optional<size_t> place = FindPhoto(statement, side);
    if (!place || photo.committed_size_bytes() < 0 || photo.committed_size_bytes() > statement.photos[*place].size) {
      return FieldInvalid("photos", "not the photographs that were stated");
    }
    upload.committed_sizes[*place] = photo.committed_size_bytes();
  }
  return upload;
}

}  // namespace fitroom::remote
