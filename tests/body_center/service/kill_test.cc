// SIGKILL at any time loses no acknowledged scan and leaves no half one.

#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <random>
#include <string>
#include <thread>

#include <gtest/gtest.h>

#include "common/remote/body_client.h"
#include "tests/support/service/fake_scan.h"
#include "tests/support/temporary_folder.h"

namespace fitroom::testing {
namespace {

// A server in a process of its own.
class ServerProcess {
 public:
  explicit ServerProcess(const std::filesystem::path& data) {
    std::array<int, 2> pipe_ends{};
    FR_CHECK(::pipe(pipe_ends.data()) == 0);
    process_ = ::fork();
    if (process_ == 0) {
      ::dup2(pipe_ends[1], STDOUT_FILENO);
      ::close(pipe_ends[0]);
      ::execl(FITROOM_KILL_SERVER, FITROOM_KILL_SERVER, data.c_str(), nullptr);
      ::_exit(127);
    }
    ::close(pipe_ends[1]);
    char c = 0;
    while (::read(pipe_ends[0], &c, 1) == 1 && c != '\n') address_ += c;
    ::close(pipe_ends[0]);
  }
  ServerProcess(const ServerProcess&) = delete;
  ServerProcess& operator=(const ServerProcess&) = delete;
  ~ServerProcess() { End(SIGKILL); }

  const std::string& address() const { return address_; }
  // Sends a signal, waits for the end, and returns the exit code; -1 if a signal ended it.
  int End(int signal) {
    if (process_ <= 0) return -1;
    ::kill(process_, signal);
    int status = 0;
    ::waitpid(process_, &status, 0);
    process_ = -1;
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

 private:
  pid_t process_ = -1;
  std::string address_;
};

struct Acknowledged {
  uint32_t seed = 0;
  size_t size = 0;
};

// Downloads a scan and compares it with the file that was sent.
void ExpectIntact(remote::BodyClient& client, const ScanName& name, const Acknowledged& sent) {
  const std::string file = FakeScanFile(sent.seed, sent.size);
  std::string original;
  const Status status = client.Download(name, ScanContent::kOriginal, 0, [&](std::string_view part) {
    original += part;
    return Status();
  });
  ASSERT_TRUE(status.ok()) << ToString(name) << ": " << status.ToString();
  EXPECT_TRUE(original == file) << ToString(name);
}

void KillAndVerify(int kill_count, uint32_t seed) {
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937 random(seed);
  const TemporaryFolder folder;
  std::map<ScanName, Acknowledged> acknowledged;
  uint32_t file_seed = 0;
  for (int kill = 0; kill < kill_count; ++kill) {
    ServerProcess server(folder.path() / "data");
    ASSERT_FALSE(server.address().empty());
    std::atomic<bool> is_dead{false};
    std::thread registering([&] {
      remote::BodyClient client(server.address(), /*attempt_count=*/1);
      while (!is_dead) {
        const Acknowledged sent{++file_seed, size_t{1000} << (file_seed % 11)};
        const std::string file = FakeScanFile(sent.seed, sent.size);
        const ScanUploadStatement statement =
            StatementOf("b" + std::to_string(kill), "s" + std::to_string(sent.seed), file);
        // One attempt each: what is not acknowledged may be lost.
        const Result<ScanUpload> upload = client.StartUpload(statement);
        if (!upload.ok() || !client.SendBytes(*upload, 0, file, {}).ok()) continue;
        const Result<ScanRecord> scan = client.FinishUpload(*upload, statement.hash);
        if (scan.ok()) acknowledged[statement.name] = sent;
      }
    });
    std::this_thread::sleep_for(std::chrono::milliseconds(std::uniform_int_distribution<>(20, 400)(random)));
    server.End(SIGKILL);
    is_dead = true;
    registering.join();
  }
  EXPECT_GT(acknowledged.size(), static_cast<size_t>(kill_count) / 4) << "hardly anything was registered";
  ServerProcess server(folder.path() / "data");
  remote::BodyClient client(server.address());
  const Result<std::vector<ScanRecord>> listed = client.ListAllScans("");
  ASSERT_TRUE(listed.ok()) << listed.status().ToString();
  // An unacknowledged scan may be there (the answer was lost), but then it is whole.
  std::map<ScanName, Acknowledged> all = acknowledged;
  for (const ScanRecord& scan : *listed) {
    const uint32_t its_seed = static_cast<uint32_t>(std::stoul(scan.name.scan.substr(1)));
    all[scan.name] = {its_seed, size_t{1000} << (its_seed % 11)};
  }
  EXPECT_EQ(all.size(), listed->size()) << "an acknowledged scan is lost";
  for (const auto& [name, sent] : all) ExpectIntact(client, name, sent);
  EXPECT_EQ(server.End(SIGTERM), 0);
}

uint32_t SeedFromEnvironment() {
  const char* seed = std::getenv("FITROOM_TEST_SEED");
  return seed != nullptr ? static_cast<uint32_t>(std::strtoul(seed, nullptr, 10)) : 20240607u;
}

TEST(Kill, LosesNoAcknowledgedScan) { KillAndVerify(FITROOM_KILL_COUNT, SeedFromEnvironment()); }

// The client's view of the same death: one call survives a server that dies and comes back on the same port.
TEST(Kill, AnUploadGoesOnWithTheNextServer) {
  const TemporaryFolder folder;
  const std::string file = FakeScanFile(5, size_t{24} << 20);
  const ScanUploadStatement statement = StatementOf("a", "b", file);
  int64_t held = 0;
  {
    ServerProcess server(folder.path() / "data");
    remote::BodyClient client(server.address());
    const Result<ScanUpload> upload = client.StartUpload(statement);
    ASSERT_TRUE(upload.ok());
    ASSERT_TRUE(client.SendBytes(*upload, 0, std::string_view(file).substr(0, 9 << 20), {}).ok());
    const Status cut = client
                           .SendBytes(*upload, 9 << 20, std::string_view(file).substr(9 << 20),
                                      [&](int64_t sent) {
                                        if (sent > 18 << 20) server.End(SIGKILL);
                                      })
                           .status();
    EXPECT_EQ(cut.code(), StatusCode::kUnavailable) << cut.ToString();
  }
  ServerProcess server(folder.path() / "data");
  remote::BodyClient client(server.address());
  const Result<ScanUpload> upload = client.StartUpload(statement);
  ASSERT_TRUE(upload.ok());
  held = upload->committed_size;
  EXPECT_GE(held, 9 << 20) << "what was acknowledged is held";
  const Result<ScanRecord> scan = client.Register(statement, file, {});
  ASSERT_TRUE(scan.ok()) << scan.status().ToString();
  ExpectIntact(client, statement.name, {5, file.size()});
}

}  // namespace
}  // namespace fitroom::testing
