#pragma once

#include <chrono>
#include <memory>
#include <string>
#include <vector>

#include "common/base/status.h"

namespace grpc {
class Server;
class Service;
}  // namespace grpc

namespace fitroom::rpc {

struct ServerOptions {
  std::string listen = "127.0.0.1:0";           // Host and port; loopback only; port 0: any free one.
  std::chrono::milliseconds drain_time{10000};  // How long running calls may go on after Shutdown().
  int max_request_size = 1 << 20;               // (unit: byte)
};

// A running gRPC server as a value. Offers the given services and grpc.health.v1. Owned by one thread.
class Server {
 public:
  // Starts to serve. FAILED_PRECONDITION [LISTEN_NOT_LOOPBACK] for any other address than loopback: without credentials
  // nobody else may connect. INVALID_ARGUMENT [LISTEN_ADDRESS_INVALID]; UNAVAILABLE [LISTEN_FAILED] if the port is
  // taken. The services must outlive the server.
  static Result<std::unique_ptr<Server>> Start(const ServerOptions& options,
                                               const std::vector<grpc::Service*>& services);
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;
  ~Server();  // Shuts down, if that has not been done.

  // Host and the port that was really bound.
  const std::string& address() const { return address_; }

  // Turns health to NOT_SERVING, takes no new calls, lets running ones end for the drain time, then cuts them.
  // Returns when all have ended.
  void Shutdown();

 private:
  Server() = default;
  std::unique_ptr<grpc::Server> server_;
  std::string address_;
  std::chrono::milliseconds drain_time_{0};
};

// Checks that `listen` is a loopback host with a port and returns it as gRPC understands it ("localhost" becomes
// 127.0.0.1, so that no name service can lead it elsewhere).
Result<std::string> CheckLoopbackAddress(const std::string& listen);

// Blocks SIGTERM and SIGINT for this thread and all threads it starts later. First thing in a server's life.
void BlockTerminationSignals();

// Waits for SIGTERM or SIGINT. BlockTerminationSignals() must have been called before any thread was started.
void WaitForTerminationSignal();

}  // namespace fitroom::rpc
