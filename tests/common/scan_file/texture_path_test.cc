// A scan file may name other files. They are read as text and never opened: watched by the kernel.
#include <sys/inotify.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "common/scan_file/ase_writer.h"
#include "common/scan_file/scan_file.h"
#include "tests/common/scan_file/sample_mesh.h"
#include "tests/support/temporary_folder.h"

namespace fitroom {
namespace {

// Counts what is opened in one folder, by any process, while the object lives.
class OpenWatch {
 public:
  explicit OpenWatch(const std::filesystem::path& folder) : queue_(::inotify_init1(IN_NONBLOCK | IN_CLOEXEC)) {
    EXPECT_GE(::inotify_add_watch(queue_, folder.c_str(), IN_OPEN), 0);
  }
  OpenWatch(const OpenWatch&) = delete;
  OpenWatch& operator=(const OpenWatch&) = delete;
  ~OpenWatch() { ::close(queue_); }

  bool SawAnOpening() {
    char events[4096];
    return ::read(queue_, events, sizeof(events)) > 0;
  }

 private:
  int queue_;
};

// Names that lead to `file` or could lead anywhere, some hundred of them.
std::vector<std::string> MakeNames(const std::filesystem::path& file) {
  const std::string absolute = file.string();
  const std::string relative = std::filesystem::relative(file).string();
  std::vector<std::string> names = {absolute,
                                    relative,
                                    file.filename().string(),
                                    "file://" + absolute,
                                    "/etc/passwd",
                                    "/dev/zero",
                                    "/proc/self/environ",
                                    "\\\\host\\share\\skin.jpg",
                                    "C:\\scans\\skin.jpg",
                                    "C:skin.jpg",
                                    "nul",
                                    "CON",
                                    "-",
                                    "~/.ssh/id_rsa",
                                    "$HOME/x",
                                    "`touch x`",
                                    "$(touch x)",
                                    "|cat",
                                    "%s%s%n",
                                    "http://127.0.0.1/skin.jpg",
                                    " ",
                                    "."};
  for (int depth = 1; depth <= 20; ++depth) {
    std::string up, backslashes;
    for (int i = 0; i < depth; ++i) {
      up += "../";
      backslashes += "..\\";
    }
    names.push_back(up + absolute);
    names.push_back(up + "etc/passwd");
    names.push_back(backslashes + "windows\\win.ini");
    names.push_back("skin/" + up + file.filename().string());
  }
  return names;
}

TEST(TexturePath, IsReportedAndNeverOpened) {
  const testing::TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "skin.jpg";
  std::ofstream(file) << "a secret";
  const TriangleMesh mesh = testing::MakeSphere(4, 5);
  const std::vector<std::string> names = MakeNames(file);
  ASSERT_GE(names.size(), 100U);

  OpenWatch watch(folder.path());
  const std::filesystem::path previous = std::filesystem::current_path();
  std::filesystem::current_path(folder.path());  // So that a plain name would lead to the file too.
  ASSERT_FALSE(watch.SawAnOpening());
  for (const std::string& name : names) {
    AseContent content;
    content.texture_path = name;
    const Result<RawScan> ase = ReadScan(FormatAse(mesh, content), "scan.ase");
    ASSERT_TRUE(ase.ok()) << ase.status().ToString();
    EXPECT_EQ(ase->texture_path, name);
    const Result<RawScan> ply =
        ReadScan("ply\nformat ascii 1.0\ncomment TextureFile " + name +
                     "\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
                     "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
                     "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n",
                 "scan.ply");
    ASSERT_TRUE(ply.ok()) << ply.status().ToString();
    const Result<RawScan> obj =
        ReadScan("mtllib " + name + "\nusemtl " + name + "\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "scan.obj");
    ASSERT_TRUE(obj.ok()) << obj.status().ToString();
  }
  EXPECT_FALSE(watch.SawAnOpening());

  std::ifstream(file).get();  // The watch itself works.
  EXPECT_TRUE(watch.SawAnOpening());
  std::filesystem::current_path(previous);
}

}  // namespace
}  // namespace fitroom
