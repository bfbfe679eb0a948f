#include "common/scan_record/scan_record.h"

#include "common/base/resource_name.h"

namespace fitroom {

std::string ToString(const ScanName& name) { return "bodies/" + name.body + "/scans/" + name.scan; }

Result<ScanName> ParseScanName(std::string_view text) {
  constexpr std::string_view kBodies = "bodies/";
  constexpr std::string_view kScans = "/scans/";
  const Status invalid = InvalidArgument(
      "SCAN_NAME_INVALID", "a scan's name is bodies/BODY/scans/SCAN, each id of 1 to 63 of a-z, 0-9 and -");
  if (!text.starts_with(kBodies)) return invalid;
  text.remove_prefix(kBodies.size());
  const size_t middle = text.find(kScans);
  if (middle == std::string_view::npos) return invalid;
  const std::string_view body = text.substr(0, middle);
  const std::string_view scan = text.substr(middle + kScans.size());
  if (!IsResourceId(body) || !IsResourceId(scan)) return invalid;
  return ScanName{std::string(body), std::string(scan)};
}

}  // namespace fitroom
