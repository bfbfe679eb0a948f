// What only shows on the wire: foreign bytes, stalled and cut streams, drain, addresses, error details.

#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include <gmock/gmock.h>
#include <grpcpp/create_channel.h>
#include <gtest/gtest.h>

#include "body_center/service/body_server.h"
#include "common/codec/crc32c.h"
#include "common/remote/body_client.h"
#include "common/rpc/client.h"
#include "common/rpc/status_conversion.h"
#include "common/transfer/chunk.h"
#include "fitroom/body/v1/scan_service.grpc.pb.h"
#include "tests/support/service/fake_scan.h"
#include "tests/support/temporary_folder.h"

namespace fitroom::testing {
namespace {

using ::testing::HasSubstr;
namespace v1 = body::v1;

// Lets one acceptor run wait until the test opens it.
class Gate {
 public:
  void Wait() {
    std::unique_lock lock(mutex_);
    ++waiting_;
    changed_.notify_all();
    changed_.wait(lock, [this] { return open_; });
  }
  void AwaitWaiter() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return waiting_ > 0; });
  }
  void Open() {
    const std::lock_guard lock(mutex_);
    open_ = true;
    changed_.notify_all();
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  int waiting_ = 0;
  bool open_ = false;
};

class ScanServiceTest : public ::testing::Test {
 protected:
  void SetUp() override { Serve({}); }

  void Serve(body_center::BodyServerOptions options) {
    server_.reset();
    options.data_folder = folder_.path() / "data";
    if (!gate_) options.acceptor = FakeAcceptor;
    if (gate_) {
      options.acceptor = [this](auto bytes, auto name, const auto& overrides, const auto& is_cancelled) {
        gate_->Wait();
        return FakeAcceptor(bytes, name, overrides, is_cancelled);
      };
    }
    auto server = body_center::BodyServer::Start(options);
    ASSERT_TRUE(server.ok()) << server.status().ToString();
    server_ = std::move(server).value();
    stub_ = v1::ScanService::NewStub(rpc::OpenChannel(server_->address()));
    client_ = std::make_unique<remote::BodyClient>(server_->address());
  }

  template <typename Request, typename Response>
  Status Call(grpc::Status (v1::ScanService::Stub::*method)(grpc::ClientContext*, const Request&, Response*),
              const Request& request, Response& response) {
    const auto context = rpc::MakeClientContext(std::chrono::seconds(10));
    return rpc::FromGrpcStatus((stub_.get()->*method)(context.get(), request, &response), "server");
  }

  // Sends the messages as one stream and returns how it ended.
  Status Send(const std::vector<v1::UploadScanRequest>& messages) {
    const auto context = rpc::MakeClientContext(std::chrono::seconds(10));
    v1::UploadScanResponse response;
    const auto writer = stub_->UploadScan(context.get(), &response);
    for (const v1::UploadScanRequest& message : messages) {
      if (!writer->Write(message)) break;
    }
    writer->WritesDone();
    return rpc::FromGrpcStatus(writer->Finish(), "server");
  }

  static v1::UploadScanRequest Message(const std::string& upload, int64_t offset, std::string_view data) {
    v1::UploadScanRequest message;
    message.set_upload(upload);
    transfer::FillChunk(offset, data, *message.mutable_chunk());
    return message;
  }
  static std::string NameOf(const ScanUpload& upload) {
    return "bodies/" + upload.statement.name.body + "/uploads/" + upload.id;
  }

  TemporaryFolder folder_;
  std::unique_ptr<Gate> gate_;
  std::unique_ptr<body_center::BodyServer> server_;
  std::unique_ptr<v1::ScanService::Stub> stub_;
  std::unique_ptr<remote::BodyClient> client_;
};

TEST_F(ScanServiceTest, RefusesForeignNames) {
  for (const char* name :
       {"", "/", "bodies", "bodies/", "bodies//scans/a", "bodies/A/scans/a", "bodies/a/scans/", "bodies/a/scans/../b",
        "bodies/a/scans/b/c", "bodies/a/scans/b\n", "garments/a", "bodies/a b/scans/c", "bodies/\xc3\xa4/scans/a",
        "bodies/a/scan/b", "bodies/aaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaa/scans/b"}) {
    v1::GetScanRequest request;
    request.set_name(name);
    v1::GetScanResponse response;
    EXPECT_EQ(Call(&v1::ScanService::Stub::GetScan, request, response).reason(), "SCAN_NAME_INVALID") << name;
  }
}

TEST_F(ScanServiceTest, RefusesStatementsOutOfRange) {
  const std::string file = FakeScanFile(1, 100);
  v1::StartScanUploadRequest good;
  good.set_name("bodies/a/scans/b");
  good.set_file_name("a.ase");
  good.set_size_bytes(100);
  good.set_blake2b_256(std::string(Blake2b(file).view()));
  const std::vector<std::function<void(v1::StartScanUploadRequest&)>> spoilers = {
      [](auto& r) { r.set_size_bytes(0); },
      [](auto& r) { r.set_size_bytes(-1); },
      [](auto& r) { r.set_size_bytes((int64_t{256} << 20) + 1); },
      [](auto& r) { r.set_size_bytes(INT64_MAX); },
      [](auto& r) { r.set_blake2b_256("short"); },
      [](auto& r) { r.set_blake2b_256(std::string(33, 'x')); },
      [](auto& r) { r.set_file_name(""); },
      [](auto& r) { r.set_file_name(std::string(300, 'n')); },
      [](auto& r) { r.set_file_name("a\nb"); },
      [](auto& r) { r.set_file_name("folder/"); },
      [](auto& r) { r.set_unit("parsec"); },
      [](auto& r) { r.set_up(static_cast<v1::Axis>(17)); },
      [](auto& r) { r.set_facing(static_cast<v1::Axis>(-3)); },
  };
  v1::StartScanUploadResponse response;
  for (size_t i = 0; i < spoilers.size(); ++i) {
    v1::StartScanUploadRequest bad = good;
    spoilers[i](bad);
    EXPECT_EQ(Call(&v1::ScanService::Stub::StartScanUpload, bad, response).code(), StatusCode::kInvalidArgument) << i;
  }
  EXPECT_TRUE(Call(&v1::ScanService::Stub::StartScanUpload, good, response).ok());
}

TEST_F(ScanServiceTest, RefusesDamagedAndForeignChunks) {
  const std::string file = FakeScanFile(1, 600000);
  const Result<ScanUpload> upload = client_->StartUpload(StatementOf("a", "b", file));
  ASSERT_TRUE(upload.ok());
  const std::string name = NameOf(*upload);
  v1::UploadScanRequest damaged = Message(name, 0, file.substr(0, 1000));
  (*damaged.mutable_chunk()->mutable_data())[500] ^= 1;
  EXPECT_EQ(Send({damaged}).reason(), "CHUNK_CHECKSUM_MISMATCH");
  v1::UploadScanRequest lying = Message(name, 0, file.substr(0, 1000));
  lying.mutable_chunk()->set_crc32c(-1);
  EXPECT_EQ(Send({lying}).reason(), "CHUNK_CHECKSUM_MISMATCH");
  EXPECT_EQ(Send({Message(name, 0, file.substr(0, (256 << 10) + 1))}).reason(), "CHUNK_SIZE_INVALID");
  EXPECT_EQ(Send({Message(name, 0, "")}).reason(), "CHUNK_SIZE_INVALID");
  EXPECT_EQ(Send({Message("", 0, "abc")}).reason(), "UPLOAD_NAME_INVALID");
  EXPECT_EQ(Send({}).reason(), "UPLOAD_NAME_INVALID");
  EXPECT_EQ(Send({Message(name, 0, "abc"), Message(name, 3, "def")}).reason(), "UPLOAD_NAME_INVALID");
  EXPECT_EQ(Send({Message("bodies/a/uploads/unknown", 0, "abc")}).reason(), "UPLOAD_NOT_FOUND");
  EXPECT_EQ(client_->GetUpload(*upload)->committed_size, 0);
}

// A chunk past the stated end is refused alone: what came before it is kept, and the upload ends well in another
// stream.
TEST_F(ScanServiceTest, AnUploadThatIsTooLongGoesOnFromWhereItWasRight) {
  const std::string file = FakeScanFile(1, 600000);
  const Result<ScanUpload> upload = client_->StartUpload(StatementOf("a", "b", file));
  ASSERT_TRUE(upload.ok());
  const std::string name = NameOf(*upload);
  EXPECT_EQ(Send({Message(name, 0, file.substr(0, 200000)), Message("", 200000, file.substr(200000, 200000)),
                  Message("", 400000, file.substr(400000) + "x")})
                .reason(),
            "UPLOAD_TOO_LONG");
  EXPECT_EQ(client_->GetUpload(*upload)->committed_size, 400000);
  EXPECT_TRUE(Send({Message(name, 400000, file.substr(400000))}).ok());
  EXPECT_EQ(Send({Message(name, 600000, "x")}).reason(), "UPLOAD_TOO_LONG");
  EXPECT_EQ(client_->GetUpload(*upload)->committed_size, 600000);
  const auto finished = client_->FinishUpload(*upload, Blake2b(file));
  EXPECT_TRUE(finished.ok()) << finished.status().ToString();
}

// An upload belongs to the body in its name: under another's it is not there, and cannot be dropped.
TEST_F(ScanServiceTest, AnUploadIsNotFoundUnderAnotherBody) {
  const std::string file = FakeScanFile(1, 5000);
  const Result<ScanUpload> upload = client_->StartUpload(StatementOf("a", "b", file));
  ASSERT_TRUE(upload.ok());
  ScanUpload other = *upload;
  other.statement.name.body = "c";
  EXPECT_EQ(Send({Message(NameOf(other), 0, file)}).reason(), "UPLOAD_NOT_FOUND");
  EXPECT_EQ(client_->GetUpload(other).status().reason(), "UPLOAD_NOT_FOUND");
  EXPECT_EQ(client_->FinishUpload(other, Blake2b(file)).status().reason(), "UPLOAD_NOT_FOUND");
  EXPECT_TRUE(client_->CancelUpload(other).ok()) << "what is not there counts as dropped";
  EXPECT_EQ(client_->GetUpload(*upload)->committed_size, 0);
}

TEST_F(ScanServiceTest, KeepsTheChunksBeforeADamagedOne) {
  const std::string file = FakeScanFile(1, 600000);
  const Result<ScanUpload> upload = client_->StartUpload(StatementOf("a", "b", file));
  ASSERT_TRUE(upload.ok());
  v1::UploadScanRequest damaged = Message("", 1000, file.substr(1000, 1000));
  (*damaged.mutable_chunk()->mutable_data())[0] ^= 1;
  EXPECT_EQ(Send({Message(NameOf(*upload), 0, file.substr(0, 1000)), damaged}).code(), StatusCode::kDataLoss);
  EXPECT_EQ(client_->GetUpload(*upload)->committed_size, 1000);
}

TEST_F(ScanServiceTest, RefusesAMessageOverTheLimit) {
  const std::string file = FakeScanFile(1, 3 << 20);
  const Result<ScanUpload> upload = client_->StartUpload(StatementOf("a", "b", file));
  ASSERT_TRUE(upload.ok());
  EXPECT_EQ(Send({Message(NameOf(*upload), 0, file)}).code(), StatusCode::kResourceExhausted);
  EXPECT_EQ(client_->GetUpload(*upload)->committed_size, 0);
}

TEST_F(ScanServiceTest, RefusesForeignPages) {
  v1::ListScansRequest request;
  v1::ListScansResponse response;
  EXPECT_EQ(Call(&v1::ScanService::Stub::ListScans, request, response).reason(), "PARENT_INVALID");
  request.set_parent("bodies/-");
  request.set_page_token("' OR 1=1 --");
  EXPECT_EQ(Call(&v1::ScanService::Stub::ListScans, request, response).reason(), "PAGE_TOKEN_INVALID");
  request.clear_page_token();
  request.set_page_size(-1);
  EXPECT_EQ(Call(&v1::ScanService::Stub::ListScans, request, response).reason(), "PAGE_SIZE_INVALID");
}

TEST_F(ScanServiceTest, RefusesUnspecifiedContent) {
  v1::DownloadScanRequest request;
  request.set_name("bodies/a/scans/b");
  const auto context = rpc::MakeClientContext(std::chrono::seconds(10));
  const auto reader = stub_->DownloadScan(context.get(), request);
  v1::DownloadScanResponse response;
  EXPECT_FALSE(reader->Read(&response));
  EXPECT_EQ(rpc::FromGrpcStatus(reader->Finish(), "server").reason(), "FIELD_INVALID");
}

TEST_F(ScanServiceTest, CutsAStalledStreamAndServesOthersMeanwhile) {
  Serve({.data_folder = {}, .listen = "127.0.0.1:0", .acceptor = {}, .stall_timeout_ms = 300});
  const std::string file = FakeScanFile(1, 600000);
  const Result<ScanUpload> upload = client_->StartUpload(StatementOf("a", "b", file));
  ASSERT_TRUE(upload.ok());
  const auto context = rpc::MakeClientContext(std::chrono::seconds(20));
  v1::UploadScanResponse response;
  const auto writer = stub_->UploadScan(context.get(), &response);
  ASSERT_TRUE(writer->Write(Message(NameOf(*upload), 0, file.substr(0, 1000))));
  const std::string other = FakeScanFile(2, 300000);
  EXPECT_TRUE(client_->Register(StatementOf("a", "c", other), other, {}).ok());
  // Nothing more is written: the server must end the stream by itself, long before the deadline.
  const Status status = rpc::FromGrpcStatus(writer->Finish(), "server");
  EXPECT_EQ(status.code(), StatusCode::kUnavailable) << status.ToString();
  // What came before the stall is kept; the server stores it after it has cut the stream.
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(10);
  while (client_->GetUpload(*upload)->committed_size != 1000 && std::chrono::steady_clock::now() < deadline) {
    std::this_thread::yield();
  }
  EXPECT_EQ(client_->GetUpload(*upload)->committed_size, 1000);
}

TEST_F(ScanServiceTest, KeepsWhatAClientSentBeforeItDied) {
  const std::string file = FakeScanFile(1, 600000);
  const Result<ScanUpload> upload = client_->StartUpload(StatementOf("a", "b", file));
  ASSERT_TRUE(upload.ok());
  {
    const auto context = rpc::MakeClientContext(std::chrono::seconds(20));
    v1::UploadScanResponse response;
    const auto writer = stub_->UploadScan(context.get(), &response);
    ASSERT_TRUE(writer->Write(Message(NameOf(*upload), 0, file.substr(0, 200000))));
    ASSERT_TRUE(writer->Write(Message("", 200000, file.substr(200000, 200000))));
    context->TryCancel();
    EXPECT_FALSE(writer->Finish().ok());
  }
  // Whatever arrived, the upload can be ended from there.
  const Result<ScanRecord> registered = client_->Register(StatementOf("a", "b", file), file, {});
  ASSERT_TRUE(registered.ok()) << registered.status().ToString();
  EXPECT_EQ(registered->original_hash, Blake2b(file));
}

TEST_F(ScanServiceTest, EndsRunningWorkBeforeItShutsDown) {
  gate_ = std::make_unique<Gate>();
  Serve({});
  const std::string file = FakeScanFile(1, 5000);
  Result<ScanRecord> registered = Internal("NOT_RUN", "not run");
  std::thread registering([&] { registered = client_->Register(StatementOf("a", "b", file), file, {}); });
  gate_->AwaitWaiter();
  std::thread stopping([&] { server_->Shutdown(); });
  gate_->Open();
  registering.join();
  stopping.join();
  EXPECT_TRUE(registered.ok()) << registered.status().ToString();
}

TEST_F(ScanServiceTest, RegisteringTwiceIsOneScan) {
  const std::string file = FakeScanFile(1, 5000);
  const Result<ScanRecord> first = client_->Register(StatementOf("a", "b", file), file, {});
  const Result<ScanRecord> again = client_->Register(StatementOf("a", "b", file), file, {});
  ASSERT_TRUE(first.ok() && again.ok()) << again.status().ToString();
  EXPECT_EQ(again->original_hash, first->original_hash);
  const std::string other = FakeScanFile(2, 5000);
  EXPECT_EQ(client_->Register(StatementOf("a", "b", other), other, {}).status().reason(), "SCAN_EXISTS");
}

TEST_F(ScanServiceTest, ListensOnLoopbackOnly) {
  for (const char* listen : {"0.0.0.0:0", "[::]:0", "192.168.1.4:5000", "10.0.0.1:0", "example.org:80",
                             "[2001:db8::1]:1", "128.0.0.1:0", "::1.example:0", "unix:socket:1"}) {
    const auto server = body_center::BodyServer::Start({.data_folder = folder_.path() / "other", .listen = listen});
    ASSERT_FALSE(server.ok()) << listen;
    EXPECT_EQ(server.status().reason(), "LISTEN_NOT_LOOPBACK") << listen;
    EXPECT_THAT(server.status().message(), HasSubstr("127.0.0.1"));
  }
  for (const char* listen :
       {"", ":", "127.0.0.1", "127.0.0.1:", "127.0.0.1:x", "127.0.0.1:65536", "127.0.0.1:-1", ":80"}) {
    const auto server = body_center::BodyServer::Start({.data_folder = folder_.path() / "other", .listen = listen});
    ASSERT_FALSE(server.ok()) << listen;
    EXPECT_EQ(server.status().reason(), "LISTEN_ADDRESS_INVALID") << listen;
  }
  EXPECT_FALSE(std::filesystem::exists(folder_.path() / "other"));
}

TEST_F(ScanServiceTest, RefusesAPortThatIsTakenAndAFolderInUse) {
  const auto port =
      body_center::BodyServer::Start({.data_folder = folder_.path() / "other", .listen = server_->address()});
  ASSERT_FALSE(port.ok());
  EXPECT_EQ(port.status().reason(), "LISTEN_FAILED");
  const auto data = body_center::BodyServer::Start({.data_folder = folder_.path() / "data"});
  ASSERT_FALSE(data.ok());
  EXPECT_EQ(data.status().reason(), "FOLDER_IN_USE");
}

TEST_F(ScanServiceTest, AServerThatIsDownIsUnavailable) {
  const std::string address = server_->address();
  server_.reset();
  remote::BodyClient client(address);
  const Status status = client.GetScan({"a", "b"}).status();
  EXPECT_EQ(status.code(), StatusCode::kUnavailable);
  EXPECT_EQ(status.reason(), "SERVER_UNAVAILABLE");
  EXPECT_THAT(status.message(), HasSubstr(address));
}

TEST(ServerDetails, ErrorsCarryTheirReasonAsGoogleRpcErrorInfo) {
  const grpc::Status wire = rpc::ToGrpcStatus(NotFound("SCAN_NOT_FOUND", "no such scan"));
  // Field 3 of google.rpc.Status, an Any whose type URL and ErrorInfo any tool can read.
  EXPECT_THAT(wire.error_details(), HasSubstr("type.googleapis.com/google.rpc.ErrorInfo"));
  EXPECT_THAT(wire.error_details(), HasSubstr("SCAN_NOT_FOUND"));
  for (int code = 1; code <= 16; ++code) {
    const Status status(static_cast<StatusCode>(code), "SOME_REASON", "message");
    const Status back = rpc::FromGrpcStatus(rpc::ToGrpcStatus(status), "server");
    EXPECT_EQ(back.code(), status.code());
    EXPECT_EQ(back.reason(), "SOME_REASON");
    EXPECT_EQ(back.message(), "message");
  }
  EXPECT_TRUE(rpc::FromGrpcStatus(rpc::ToGrpcStatus(Status()), "server").ok());
}

}  // namespace
}  // namespace fitroom::testing
