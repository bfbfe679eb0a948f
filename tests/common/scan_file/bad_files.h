#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace fitroom::testing {

// A file that no reader may take, by name, and the reasons of which one must be given for refusing it. Made on demand,
// since some are large.
struct BadFile {
  std::string name;
  std::vector<std::string_view> reasons;
  std::function<std::string()> make;
};

std::vector<BadFile> MakeBadAseFiles();
std::vector<BadFile> MakeBadPlyFiles();
std::vector<BadFile> MakeBadObjFiles();
std::vector<BadFile> MakeForeignFiles();    // Pictures, archives, texts: no scans at all.
std::vector<BadFile> MakeBadPackedFiles();  // zstd frames and UTF-16.

}  // namespace fitroom::testing
