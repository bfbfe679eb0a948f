#include "body_center/cli/scan_table.h"

#include <array>
#include <cstdio>
#include <ctime>

#include "common/scan_record/scan_record_json.h"

namespace fitroom::body_center {
namespace {

std::string TimeText(int64_t unix_s) {
  const std::time_t time = unix_s;
  std::tm utc{};
  ::gmtime_r(&time, &utc);
  std::array<char, 32> text{};
  std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%SZ", &utc);
  return text.data();
}

template <typename... Arguments>
std::string Format(const char* pattern, Arguments... arguments) {
  std::array<char, 512> text{};
  std::snprintf(text.data(), text.size(), pattern, arguments...);
  return text.data();
}

void PrintGirth(const char* name, const GirthMeasurement& girth, std::ostream& out) {
  out << Format("  %-8s %6.1f cm at %5.1f cm\n", name, girth.girth * 100, girth.height * 100);
}

}  // namespace

void PrintScanTable(std::span<const ScanRecord> scans, std::ostream& out) {
  out << Format("%-40s %-20s %9s %8s %6s %6s %6s\n", "NAME", "REGISTERED", "VERTICES", "STATURE", "BUST", "WAIST",
                "HIP");
  for (const ScanRecord& scan : scans) {
    const BodyMeasurements& measured = scan.measurements;
    out << Format("%-40s %-20s %9lld %8.1f %6.1f %6.1f %6.1f\n", ToString(scan.name).c_str(),
                  TimeText(scan.register_time_unix_s).c_str(), static_cast<long long>(scan.vertex_count),
                  measured.stature * 100, measured.bust.girth * 100, measured.waist.girth * 100,
                  measured.hip.girth * 100);
  }
}

void PrintScan(const ScanRecord& scan, std::ostream& out) {
  out << ToString(scan.name) << "\n"
      << "  file     " << scan.file_name << ", " << scan.original_size << " bytes\n"
      << "  hash     " << scan.original_hash.ToHex() << "\n"
      << "  since    " << TimeText(scan.register_time_unix_s) << "\n"
      << "  mesh     " << scan.vertex_count << " vertices, " << scan.triangle_count << " triangles, "
      << scan.packed_mesh_size << " bytes packed\n"
      << "  frame    up " << scan.frame.up << ", facing " << scan.frame.facing << ", unit " << scan.frame.unit << "\n";
  for (const std::string& reason : scan.frame.reasons) out << "           " << reason << "\n";
  out << Format("  stature  %6.1f cm\n", scan.measurements.stature * 100);
  PrintGirth("bust", scan.measurements.bust, out);
  PrintGirth("waist", scan.measurements.waist, out);
  PrintGirth("hip", scan.measurements.hip, out);
  PrintGirth("neck", scan.measurements.neck, out);
  out << "  landmarks, in metres: x to the body's left, y up, z to the front\n";
  for (int i = 0; i < kBodyLandmarkCount; ++i) {
    const auto landmark = static_cast<BodyLandmark>(i);
    const LandmarkEstimate& estimate = scan.landmarks[landmark];
    if (estimate.confidence <= 0) continue;
    out << Format("    %-16s %7.3f %7.3f %7.3f  confidence %.2f\n", std::string(LandmarkName(landmark)).c_str(),
                  estimate.position.x(), estimate.position.y(), estimate.position.z(), estimate.confidence);
  }
}

std::string ScansToJson(std::span<const ScanRecord> scans) {
  std::string json = "[";
  for (size_t i = 0; i < scans.size(); ++i) {
    std::string one = ScanRecordToJson(scans[i]);
    one.pop_back();  // The line's end.
    json += (i == 0 ? "\n" : ",\n") + one;
  }
  return json + (scans.empty() ? "]\n" : "\n]\n");
}

Result<ScanName> ScanNameFromUser(const std::string& text) {
  const size_t slash = text.find('/');
  if (slash != std::string::npos && text.find('/', slash + 1) == std::string::npos) {
    return ParseScanName("bodies/" + text.substr(0, slash) + "/scans/" + text.substr(slash + 1));
  }
  return ParseScanName(text);
}

}  // namespace fitroom::body_center
