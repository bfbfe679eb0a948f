#include "body_center/store/sqlite_scan_rows.h"

#include <algorithm>
#include <array>
#include <utility>

#include "common/store/columns.h"

namespace fitroom::body_center {

using sqlite::Database;
using sqlite::Statement;
using store::HashBytes;
using store::HashFromRow;

const char kScanSchema[] = R"sql(
CREATE TABLE scans (
  scan_key INTEGER PRIMARY KEY AUTOINCREMENT,
  body TEXT NOT NULL,
  scan TEXT NOT NULL,
  file_name TEXT NOT NULL,
  original_blob_id INTEGER NOT NULL REFERENCES blobs (blob_id),
  original_size_bytes INTEGER NOT NULL,
  original_blake2b_256 BLOB NOT NULL CHECK (length(original_blake2b_256) = 32),
  packed_mesh_blob_id INTEGER NOT NULL REFERENCES blobs (blob_id),
  packed_mesh_size_bytes INTEGER NOT NULL,
  packed_mesh_blake2b_256 BLOB NOT NULL CHECK (length(packed_mesh_blake2b_256) = 32),
  register_time_unix_s INTEGER NOT NULL,
  vertex_count INTEGER NOT NULL,
  triangle_count INTEGER NOT NULL,
  frame_up TEXT NOT NULL,
  frame_facing TEXT NOT NULL,
  frame_unit TEXT NOT NULL,
  frame_tilt_deg REAL NOT NULL,
  frame_yaw_deg REAL NOT NULL,
  frame_reasons TEXT NOT NULL,
  stature_m REAL NOT NULL,
  bust_girth_m REAL NOT NULL, bust_height_m REAL NOT NULL,
  waist_girth_m REAL NOT NULL, waist_height_m REAL NOT NULL,
  hip_girth_m REAL NOT NULL, hip_height_m REAL NOT NULL,
  neck_girth_m REAL NOT NULL, neck_height_m REAL NOT NULL,
  UNIQUE (body, scan)
) STRICT;
CREATE INDEX scans_by_original_blob ON scans (original_blob_id);
CREATE INDEX scans_by_packed_mesh_blob ON scans (packed_mesh_blob_id);
CREATE TABLE scan_landmarks (
  scan_key INTEGER NOT NULL REFERENCES scans (scan_key) ON DELETE CASCADE,
  landmark TEXT NOT NULL,
  x_m REAL NOT NULL, y_m REAL NOT NULL, z_m REAL NOT NULL,
  confidence REAL NOT NULL,
  PRIMARY KEY (scan_key, landmark)
) STRICT;
CREATE TABLE scan_limb_axes (
  scan_key INTEGER NOT NULL REFERENCES scans (scan_key) ON DELETE CASCADE,
  limb TEXT NOT NULL,
  root_x_m REAL NOT NULL, root_y_m REAL NOT NULL, root_z_m REAL NOT NULL,
  joint_x_m REAL NOT NULL, joint_y_m REAL NOT NULL, joint_z_m REAL NOT NULL,
  end_x_m REAL NOT NULL, end_y_m REAL NOT NULL, end_z_m REAL NOT NULL,
  PRIMARY KEY (scan_key, limb)
) STRICT;
CREATE TABLE uploads (
  upload TEXT PRIMARY KEY,
  body TEXT NOT NULL,
  scan TEXT NOT NULL,
  file_name TEXT NOT NULL,
  size_bytes INTEGER NOT NULL,
  blake2b_256 BLOB NOT NULL CHECK (length(blake2b_256) = 32),
  up TEXT NOT NULL,
  facing TEXT NOT NULL,
  unit TEXT NOT NULL,
  blob_id INTEGER NOT NULL REFERENCES blobs (blob_id),
  touch_time_unix_s INTEGER NOT NULL,
  UNIQUE (body, scan)
) STRICT;
CREATE INDEX uploads_by_blob ON uploads (blob_id);
)sql";

const char kScanIndexSchema[] = R"sql(
CREATE INDEX IF NOT EXISTS scans_by_original_blob ON scans (original_blob_id);
CREATE INDEX IF NOT EXISTS scans_by_packed_mesh_blob ON scans (packed_mesh_blob_id);
CREATE INDEX IF NOT EXISTS uploads_by_blob ON uploads (blob_id);
)sql";

namespace {

constexpr char kScanColumns[] =
    "scan_key, body, scan, file_name, original_size_bytes, original_blake2b_256, packed_mesh_size_bytes, "
    "packed_mesh_blake2b_256, register_time_unix_s, vertex_count, triangle_count, frame_up, frame_facing, frame_unit, "
    "frame_tilt_deg, frame_yaw_deg, frame_reasons, stature_m, bust_girth_m, bust_height_m, waist_girth_m, "
    "waist_height_m, hip_girth_m, hip_height_m, neck_girth_m, neck_height_m";

using LimbField = std::pair<const char*, LimbAxis ScanRecord::*>;
constexpr std::array<LimbField, 4> kLimbs = {{{"arm_L", &ScanRecord::arm_left},
                                              {"arm_R", &ScanRecord::arm_right},
                                              {"leg_L", &ScanRecord::leg_left},
                                              {"leg_R", &ScanRecord::leg_right}}};

std::array<GirthMeasurement*, 4> Girths(BodyMeasurements& measurements) {
  return {&measurements.bust, &measurements.waist, &measurements.hip, &measurements.neck};
}

// Reasons are sentences without line breaks, kept one a line.
std::string JoinLines(const std::vector<std::string>& lines) {
  std::string text;
  for (std::string line : lines) {
    std::replace(line.begin(), line.end(), '\n', ' ');
    text += line + '\n';
  }
  return text;
}

std::vector<std::string> SplitLines(const std::string& text) {
  std::vector<std::string> lines;
  for (size_t start = 0; start < text.size();) {
    const size_t end = std::min(text.find('\n', start), text.size());
    lines.push_back(text.substr(start, end - start));
    start = end + 1;
  }
  return lines;
}

void BindPoint(Statement& statement, int parameter, const Eigen::Vector3d& point) {
  for (int i = 0; i < 3; ++i) statement.Bind(parameter + i, point[i]);
}

Eigen::Vector3d ReadPoint(const Statement& statement, int column) {
  return {statement.Real(column), statement.Real(column + 1), statement.Real(column + 2)};
}

Status InsertDetails(Database& database, const ScanRecord& scan, int64_t key) {
  FR_ASSIGN_OR_RETURN(Statement landmarks, database.Prepare("INSERT INTO scan_landmarks (scan_key, landmark, x_m, y_m, "
                                                            "z_m, confidence) VALUES (?1, ?2, ?3, ?4, ?5, ?6)"));
  for (int i = 0; i < kBodyLandmarkCount; ++i) {
    const auto landmark = static_cast<BodyLandmark>(i);
    const LandmarkEstimate& estimate = scan.landmarks[landmark];
    if (estimate.confidence <= 0) continue;
    landmarks.Bind(1, key).Bind(2, LandmarkName(landmark)).Bind(6, estimate.confidence);
    BindPoint(landmarks, 3, estimate.position);
    FR_RETURN_IF_ERROR(landmarks.Run());
  }
  FR_ASSIGN_OR_RETURN(Statement limbs,
                      database.Prepare("INSERT INTO scan_limb_axes (scan_key, limb, root_x_m, root_y_m, root_z_m, "
                                       "joint_x_m, joint_y_m, joint_z_m, end_x_m, end_y_m, end_z_m) "
                                       "VALUES (?1, ?2, ?3, ?4, ?5, ?6, ?7, ?8, ?9, ?10, ?11)"));
  for (const auto& [name, field] : kLimbs) {
    limbs.Bind(1, key).Bind(2, std::string_view(name));
    BindPoint(limbs, 3, (scan.*field).root);
    BindPoint(limbs, 6, (scan.*field).joint);
    BindPoint(limbs, 9, (scan.*field).end);
    FR_RETURN_IF_ERROR(limbs.Run());
  }
  return Status();
}

Status SelectDetails(Database& database, int64_t key, ScanRecord& scan) {
  FR_ASSIGN_OR_RETURN(
      Statement landmarks,
      database.Prepare("SELECT landmark, x_m, y_m, z_m, confidence FROM scan_landmarks WHERE scan_key = ?1"));
  landmarks.Bind(1, key);
  for (;;) {
    FR_ASSIGN_OR_RETURN(const bool has_row, landmarks.Step());
    if (!has_row) break;
    const std::optional<BodyLandmark> landmark = LandmarkFromName(landmarks.Text(0));
    if (landmark) scan.landmarks[*landmark] = {ReadPoint(landmarks, 1), landmarks.Real(4)};
  }
  FR_ASSIGN_OR_RETURN(Statement limbs,
                      database.Prepare("SELECT limb, root_x_m, root_y_m, root_z_m, joint_x_m, joint_y_m, joint_z_m, "
                                       "end_x_m, end_y_m, end_z_m FROM scan_limb_axes WHERE scan_key = ?1"));
  limbs.Bind(1, key);
  for (;;) {
    FR_ASSIGN_OR_RETURN(const bool has_row, limbs.Step());
    if (!has_row) return Status();
    for (const auto& [name, field] : kLimbs) {
      if (limbs.Text(0) == name) scan.*field = {ReadPoint(limbs, 1), ReadPoint(limbs, 4), ReadPoint(limbs, 7)};
    }
  }
}

Result<ScanRecord> ReadScanRow(Database& database, const Statement& row) {
  ScanRecord scan;
  scan.name = {row.Text(1), row.Text(2)};
  scan.file_name = row.Text(3);
  scan.original_size = row.Integer(4);
  scan.packed_mesh_size = row.Integer(6);
  FR_ASSIGN_OR_RETURN(scan.original_hash, HashFromRow(row, 5));
  FR_ASSIGN_OR_RETURN(scan.packed_mesh_hash, HashFromRow(row, 7));
  scan.register_time_unix_s = row.Integer(8);
  scan.vertex_count = row.Integer(9);
  scan.triangle_count = row.Integer(10);
  scan.frame.up = row.Text(11);
  scan.frame.facing = row.Text(12);
  scan.frame.unit = row.Text(13);
  scan.frame.tilt_deg = row.Real(14);
  scan.frame.yaw_deg = row.Real(15);
  scan.frame.reasons = SplitLines(row.Text(16));
  scan.measurements.stature = row.Real(17);
  int column = 18;
  for (GirthMeasurement* girth : Girths(scan.measurements)) {
    girth->girth = row.Real(column++);
    girth->height = row.Real(column++);
  }
  FR_RETURN_IF_ERROR(SelectDetails(database, row.Integer(0), scan));
  return scan;
}

Status ScanNotFound(const ScanName& name) { return NotFound("SCAN_NOT_FOUND", ToString(name) + ": no such scan"); }

}  // namespace

Status InsertScan(Database& database, const ScanRecord& scan, int64_t original_blob, int64_t packed_mesh_blob) {
  FR_ASSIGN_OR_RETURN(
      Statement insert,
      database.Prepare("INSERT INTO scans (body, scan, file_name, original_blob_id, original_size_bytes, "
                       "original_blake2b_256, packed_mesh_blob_id, packed_mesh_size_bytes, packed_mesh_blake2b_256, "
                       "register_time_unix_s, vertex_count, triangle_count, frame_up, frame_facing, frame_unit, "
                       "frame_tilt_deg, frame_yaw_deg, frame_reasons, stature_m, bust_girth_m, bust_height_m, "
                       "waist_girth_m, waist_height_m, hip_girth_m, hip_height_m, neck_girth_m, neck_height_m) "
                       "VALUES (?1, ?2, ?3, ?4, ?5, ?6, ?7, ?8, ?9, ?10, ?11, ?12, ?13, ?14, ?15, ?16, ?17, ?18, ?19, "
                       "?20, ?21, ?22, ?23, ?24, ?25, ?26, ?27) RETURNING scan_key"));
  const std::string reasons = JoinLines(scan.frame.reasons);
  insert.Bind(1, scan.name.body).Bind(2, scan.name.scan).Bind(3, scan.file_name);
  insert.Bind(4, original_blob).Bind(5, scan.original_size).Bind(6, HashBytes(scan.original_hash));
  insert.Bind(7, packed_mesh_blob).Bind(8, scan.packed_mesh_size).Bind(9, HashBytes(scan.packed_mesh_hash));
  insert.Bind(10, scan.register_time_unix_s).Bind(11, scan.vertex_count).Bind(12, scan.triangle_count);
  insert.Bind(13, scan.frame.up).Bind(14, scan.frame.facing).Bind(15, scan.frame.unit);
  insert.Bind(16, scan.frame.tilt_deg).Bind(17, scan.frame.yaw_deg).Bind(18, reasons);
  insert.Bind(19, scan.measurements.stature);
  BodyMeasurements measurements = scan.measurements;
  int parameter = 20;
  for (const GirthMeasurement* girth : Girths(measurements)) {
    insert.Bind(parameter++, girth->girth);
    insert.Bind(parameter++, girth->height);
  }
  FR_ASSIGN_OR_RETURN(const bool has_row, insert.Step());
  if (!has_row) return Internal("DATABASE_ERROR", "database: a new scan got no key");
  return InsertDetails(database, scan, insert.Integer(0));
}

Result<ScanRecord> SelectScan(Database& database, const ScanName& name) {
  FR_ASSIGN_OR_RETURN(Statement select, database.Prepare(std::string("SELECT ") + kScanColumns +
                                                         " FROM scans WHERE body = ?1 AND scan = ?2"));
  FR_ASSIGN_OR_RETURN(const bool has_row, select.Bind(1, name.body).Bind(2, name.scan).Step());
  if (!has_row) return ScanNotFound(name);
  return ReadScanRow(database, select);
}

Result<std::vector<ScanRecord>> SelectScans(Database& database, std::string_view body, const ScanName& after,
                                            int limit) {
  FR_ASSIGN_OR_RETURN(Statement select,
                      database.Prepare(std::string("SELECT ") + kScanColumns +
                                       " FROM scans WHERE (body, scan) > (?1, ?2) AND (?3 = '' OR body = ?3) "
                                       "ORDER BY body, scan LIMIT ?4"));
  select.Bind(1, after.body).Bind(2, after.scan).Bind(3, body).Bind(4, int64_t{limit});
  std::vector<ScanRecord> scans;
  for (;;) {
    FR_ASSIGN_OR_RETURN(const bool has_row, select.Step());
    if (!has_row) return scans;
    FR_ASSIGN_OR_RETURN(ScanRecord scan, ReadScanRow(database, select));
    scans.push_back(std::move(scan));
  }
}

Result<ContentRow> SelectContent(Database& database, const ScanName& name, ScanContent content) {
  FR_ASSIGN_OR_RETURN(Statement select,
                      database.Prepare("SELECT original_blob_id, original_size_bytes, packed_mesh_blob_id, "
                                       "packed_mesh_size_bytes FROM scans WHERE body = ?1 AND scan = ?2"));
  FR_ASSIGN_OR_RETURN(const bool has_row, select.Bind(1, name.body).Bind(2, name.scan).Step());
  if (!has_row) return ScanNotFound(name);
  const int column = content == ScanContent::kOriginal ? 0 : 2;
  return ContentRow{select.Integer(column), select.Integer(column + 1)};
}

}  // namespace fitroom::body_center
