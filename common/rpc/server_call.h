#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

#include <grpcpp/support/server_callback.h>

#include "common/rpc/byte_budget.h"
#include "common/rpc/call_log.h"
#include "common/rpc/stall_watch.h"
#include "common/rpc/status_conversion.h"
#include "common/rpc/stream_limiter.h"
#include "common/rpc/worker_pool.h"

namespace fitroom::rpc {

// What the calls of one server share. Owned by the service; outlives the server.
struct CallRuntime {
  explicit CallRuntime(int thread_count = 4, const StreamLimits& limits = {})
      : streams(limits), workers(thread_count, /*queue_limit=*/256) {}

  ByteBudget bytes{int64_t{64} << 20};  // What uploads may collect before they are committed.
  StallWatch stalls;
  StreamLimiter streams;
  WorkerPool workers;  // Last: its threads end first.
};

// Runs a unary call's work on `pool` and finishes the call with its outcome; RESOURCE_EXHAUSTED if the pool is full.
inline grpc::ServerUnaryReactor* RunUnary(grpc::CallbackServerContext* context, WorkerPool& pool,
                                          std::string_view method, std::function<Status()> work) {
  grpc::ServerUnaryReactor* reactor = context->DefaultReactor();
  CallLog log(*context, method);
  const bool queued = pool.TrySubmit([reactor, log, work = std::move(work)] {
    const Status status = RunGuarded(work);
    log.Write(status);
    reactor->Finish(ToGrpcStatus(status));
  });
  if (!queued) {
    log.Write(ServerBusy());
    reactor->Finish(ToGrpcStatus(ServerBusy()));
  }
  return reactor;
}

// Takes the messages of one client stream. Called from worker threads, one call at a time.
template <typename Request>
class MessageSink {
 public:
  virtual ~MessageSink() = default;
  // Takes one message; an error ends the stream. Returns the payload's size for the log.
  virtual Result<int64_t> Accept(const Request& request) = 0;
  // The client has half-closed: fills the response.
  virtual Status Finish() = 0;
  // The stream was cut: keeps what may be kept.
  virtual void Cut() = 0;
};

// A client stream: one message in flight, worked on by the runtime's workers, cut when the client stalls.
template <typename Request>
class SinkReactor final : public grpc::ServerReadReactor<Request> {
 public:
  SinkReactor(grpc::CallbackServerContext* context, CallRuntime& runtime, std::string_view method,
              std::unique_ptr<MessageSink<Request>> sink)
      : runtime_(runtime), context_(context), log_(*context, method), sink_(std::move(sink)) {
    lease_ = runtime.stalls.Watch(runtime.streams.limits().stall_timeout, [context] { context->TryCancel(); });
    Result<StreamLimiter::Ticket> ticket = runtime.streams.Admit(context->peer());
    if (!ticket.ok()) {
      End(ticket.status());
      return;
    }
    ticket_ = std::move(ticket).value();
    Read();
  }

  void OnReadDone(bool ok) override {
    lease_->Disarm();
    const bool queued = runtime_.workers.TrySubmit([this, ok] { ok ? AcceptOne() : EndOfMessages(); });
    if (!queued) End(ServerBusy());
  }
  void OnCancel() override {}
  void OnDone() override {
    lease_->End();
    delete this;
  }

 private:
  void Read() {
    lease_->Arm();
    this->StartRead(&request_);
  }
  void AcceptOne() {
    const Status status = RunGuarded([this]() -> Status {
      FR_ASSIGN_OR_RETURN(const int64_t byte_count, sink_->Accept(request_));
      log_.CountBytes(byte_count);
      return Status();
    });
    if (status.ok()) return Read();
    End(status);
  }
  void EndOfMessages() {
    if (!context_->IsCancelled()) return End(RunGuarded([this] { return sink_->Finish(); }));
    End(RunGuarded([this]() -> Status {
      sink_->Cut();
      if (lease_->stalled()) return Status(StatusCode::kDeadlineExceeded, "STREAM_STALLED", "no progress; resume");
      return Status(StatusCode::kCancelled, "CANCELLED", "the client is gone");
    }));
  }
  void End(const Status& status) {
    log_.Write(status);
    this->Finish(ToGrpcStatus(status));
  }

  CallRuntime& runtime_;
  grpc::CallbackServerContext* const context_;
  CallLog log_;
  std::unique_ptr<MessageSink<Request>> sink_;
  std::shared_ptr<StallWatch::Lease> lease_;
  StreamLimiter::Ticket ticket_;
  Request request_;
};

// Makes the messages of one server stream. Called from worker threads, one call at a time.
template <typename Response>
class MessageSource {
 public:
  virtual ~MessageSource() = default;
  // Fills the next message and returns its payload's size; 0 at the end.
  virtual Result<int64_t> Next(Response& response) = 0;
};

// A server stream: one message in flight, made by the runtime's workers, cut when the client does not read.
template <typename Response>
class SourceReactor final : public grpc::ServerWriteReactor<Response> {
 public:
  SourceReactor(grpc::CallbackServerContext* context, CallRuntime& runtime, std::string_view method,
                std::unique_ptr<MessageSource<Response>> source)
      : runtime_(runtime), log_(*context, method), source_(std::move(source)) {
    lease_ = runtime.stalls.Watch(runtime.streams.limits().stall_timeout, [context] { context->TryCancel(); });
    Result<StreamLimiter::Ticket> ticket = runtime.streams.Admit(context->peer());
    if (!ticket.ok()) {
      End(ticket.status());
      return;
    }
    ticket_ = std::move(ticket).value();
    SubmitNext();
  }

  void OnWriteDone(bool ok) override {
    lease_->Disarm();
    if (!ok) return End(Status(StatusCode::kCancelled, "CANCELLED", "the client is gone"));
    SubmitNext();
  }
  void OnCancel() override {}
  void OnDone() override {
    lease_->End();
    delete this;
  }

 private:
  void SubmitNext() {
    if (!runtime_.workers.TrySubmit([this] { WriteNext(); })) End(ServerBusy());
  }
  void WriteNext() {
    int64_t byte_count = 0;
    const Status status = RunGuarded([this, &byte_count]() -> Status {
      FR_ASSIGN_OR_RETURN(byte_count, source_->Next(response_));
      return Status();
    });
    if (!status.ok() || byte_count == 0) return End(status);
    log_.CountBytes(byte_count);
    lease_->Arm();
    this->StartWrite(&response_);
  }
  void End(const Status& status) {
    log_.Write(status);
    this->Finish(ToGrpcStatus(status));
  }

  CallRuntime& runtime_;
  CallLog log_;
  std::unique_ptr<MessageSource<Response>> source_;
  std::shared_ptr<StallWatch::Lease> lease_;
  StreamLimiter::Ticket ticket_;
  Response response_;
};

}  // namespace fitroom::rpc
