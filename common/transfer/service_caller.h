#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

#include <grpcpp/client_context.h>
#include <grpcpp/support/sync_stream.h>

#include "common/rpc/client.h"
#include "common/rpc/status_conversion.h"
#include "common/transfer/chunk.h"

namespace fitroom::transfer {

// Calls one service of one server. Thread-safe. Its templates take the methods of the generated stub.
template <typename Service>
class ServiceCaller {
 public:
  using Stub = typename Service::Stub;

  // `server` is how messages name it. Connects with the first call. `attempt_count` is how often a call is tried in
  // all.
  ServiceCaller(std::string server, const std::string& address, int attempt_count)
      : server_(std::move(server)),
        stub_(Service::NewStub(rpc::OpenChannel(address))),
        retries_{.attempt_count = attempt_count} {}

  const std::string& server() const { return server_; }
  const rpc::RetryPolicy& retries() const { return retries_; }

  // Makes one unary call, repeated while that may help: it must be idempotent.
  template <typename Request, typename Response>
  Status Call(grpc::Status (Stub::*method)(grpc::ClientContext*, const Request&, Response*), const Request& request,
              Response& response, std::chrono::milliseconds timeout) const {
    return rpc::RetryTransient(retries_, [&] {
      const auto context = rpc::MakeClientContext(timeout);
      return Error((stub_.get()->*method)(context.get(), request, &response));
    });
  }

  // Sends `bytes`, which begin at `offset`, in one stream; `first` names the upload. Returns what the server holds
  // then.
  template <typename Request, typename Response>
  Result<int64_t> Send(std::unique_ptr<grpc::ClientWriter<Request>> (Stub::*method)(grpc::ClientContext*, Response*),
                       Request first, int64_t offset, std::string_view bytes,
                       const std::function<void(int64_t sent)>& progress) const {
    const auto context = rpc::MakeClientContext(rpc::kStreamCall);
    rpc::ClientStallGuard guard(*context);
    Response response;
    const std::unique_ptr<grpc::ClientWriter<Request>> writer = (stub_.get()->*method)(context.get(), &response);
    Request request = std::move(first);
    for (size_t sent = 0; sent < bytes.size();) {
      const std::string_view piece = bytes.substr(sent, kMaxChunkSize);
      FillChunk(offset + static_cast<int64_t>(sent), piece, *request.mutable_chunk());
      if (!writer->Write(request)) break;
      guard.Progress();
      if (sent == 0) request.Clear();  // Only the first message names the upload.
      sent += piece.size();
      if (progress) progress(offset + static_cast<int64_t>(sent));
    }
    writer->WritesDone();
    FR_RETURN_IF_ERROR(Error(writer->Finish()));
    return response.committed_size_bytes();
  }

  // Hands the bytes from `offset` on to `sink`, piece by piece; goes on by itself after a cut. `sink`'s own error ends
  // it.
  template <typename Request, typename Response>
  Status Receive(std::unique_ptr<grpc::ClientReader<Response>> (Stub::*method)(grpc::ClientContext*, const Request&),
                 Request request, int64_t offset, const std::function<Status(std::string_view)>& sink) const {
    Status sink_status;
    const Status status = rpc::RetryTransient(retries_, [&]() -> Status {
      const Status outcome = ReceiveOnce(method, request, offset, sink, sink_status);
      return sink_status.ok() ? outcome : Status();  // The sink's own error is not the line's: no second try.
    });
    return sink_status.ok() ? status : sink_status;
  }

 private:
  Status Error(const grpc::Status& status) const { return rpc::FromGrpcStatus(status, server_); }

  // One stream; `offset` moves with what `sink` has taken, so that the next one can go on there.
  template <typename Request, typename Response>
  Status ReceiveOnce(std::unique_ptr<grpc::ClientReader<Response>> (Stub::*method)(grpc::ClientContext*,
                                                                                   const Request&),
                     Request& request, int64_t& offset, const std::function<Status(std::string_view)>& sink,
                     Status& sink_status) const {
    request.set_offset_bytes(offset);
    const auto context = rpc::MakeClientContext(rpc::kStreamCall);
    rpc::ClientStallGuard guard(*context);
    const std::unique_ptr<grpc::ClientReader<Response>> reader = (stub_.get()->*method)(context.get(), request);
    Response response;
    Status taken;
    while (taken.ok() && reader->Read(&response)) {
      guard.Progress();
      taken = CheckChunk(response.chunk(), offset);
      if (taken.ok()) {
        taken = sink_status = sink(response.chunk().data());
        offset += static_cast<int64_t>(response.chunk().data().size());
      }
    }
    if (!taken.ok()) context->TryCancel();
    const Status finished = Error(reader->Finish());
    return taken.ok() ? finished : taken;
  }

  const std::string server_;
  const std::unique_ptr<Stub> stub_;
  const rpc::RetryPolicy retries_;
};

}  // namespace fitroom::transfer
