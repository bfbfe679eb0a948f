// grpc.health.v1 as a load balancer sees it: SERVING while serving, NOT_SERVING as soon as the server is told to end.

#include <chrono>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include <grpcpp/create_channel.h>
#include <grpcpp/generic/generic_stub.h>
#include <gtest/gtest.h>

#include "body_center/service/body_server.h"
#include "common/rpc/client.h"
#include "tests/support/service/fake_scan.h"
#include "tests/support/temporary_folder.h"

namespace fitroom::testing {
namespace {

// Field 1 of HealthCheckResponse as it lies on the wire: 1 is SERVING, 2 is NOT_SERVING.
const std::string kServing = "\x08\x01";
const std::string kNotServing = "\x08\x02";

std::string TextOf(const grpc::ByteBuffer& buffer) {
  std::vector<grpc::Slice> slices;
  EXPECT_TRUE(buffer.Dump(&slices).ok());
  std::string text;
  for (const grpc::Slice& slice : slices) text.append(reinterpret_cast<const char*>(slice.begin()), slice.size());
  return text;
}

// One step of an asynchronous call.
bool Await(grpc::CompletionQueue& queue) {
  void* tag = nullptr;
  bool ok = false;
  const auto deadline = std::chrono::system_clock::now() + std::chrono::seconds(20);
  return queue.AsyncNext(&tag, &ok, deadline) == grpc::CompletionQueue::GOT_EVENT && ok;
}

TEST(Health, TurnsNotServingWhenTheServerIsToldToEnd) {
  const TemporaryFolder folder;
  auto server = body_center::BodyServer::Start({.data_folder = folder.path() / "data", .acceptor = FakeAcceptor});
  ASSERT_TRUE(server.ok());
  grpc::GenericStub stub(rpc::OpenChannel((*server)->address()));
  const auto context = rpc::MakeClientContext(std::chrono::seconds(20));
  grpc::CompletionQueue queue;
  const auto watch = stub.PrepareCall(context.get(), "/grpc.health.v1.Health/Watch", &queue);
  watch->StartCall(&queue);
  ASSERT_TRUE(Await(queue));
  const grpc::Slice empty_request;
  watch->Write(grpc::ByteBuffer(&empty_request, 1), &queue);
  ASSERT_TRUE(Await(queue));
  watch->WritesDone(&queue);
  ASSERT_TRUE(Await(queue));
  grpc::ByteBuffer answer;
  watch->Read(&answer, &queue);
  ASSERT_TRUE(Await(queue));
  EXPECT_EQ(TextOf(answer), kServing);
  std::thread ending([&] { (*server)->Shutdown(); });
  watch->Read(&answer, &queue);
  EXPECT_TRUE(Await(queue));
  EXPECT_EQ(TextOf(answer), kNotServing);
  context->TryCancel();  // The watcher goes, so the drain has nothing to wait for.
  ending.join();
  grpc::Status status;
  watch->Finish(&status, &queue);
  void* tag = nullptr;
  bool ok = false;
  EXPECT_TRUE(queue.Next(&tag, &ok));
  queue.Shutdown();
}

}  // namespace
}  // namespace fitroom::testing
