// A body center with a fake acceptor, for tests that kill it: kill_server FOLDER prints its address and serves.

#include <cstdio>
#include <string>

#include <spdlog/spdlog.h>

#include "body_center/service/body_server.h"
#include "common/rpc/server.h"
#include "tests/support/service/fake_scan.h"

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  fitroom::rpc::BlockTerminationSignals();
  spdlog::set_level(spdlog::level::off);
  const auto server =
      fitroom::body_center::BodyServer::Start({.data_folder = argv[1], .acceptor = fitroom::testing::FakeAcceptor});
  if (!server.ok()) {
    std::fprintf(stderr, "%s\n", server.status().ToString().c_str());
    return 1;
  }
  std::printf("%s\n", (*server)->address().c_str());
  std::fflush(stdout);
  fitroom::rpc::WaitForTerminationSignal();
  (*server)->Shutdown();
  return 0;
}
