#include "tests/body_center/service/scan_keeper.h"

#include <gtest/gtest.h>

#include "body_center/service/body_server.h"
#include "body_center/service/registration.h"
#include "body_center/store/sqlite_body_store.h"
#include "common/remote/body_client.h"
#include "tests/support/service/fake_scan.h"
#include "tests/support/temporary_folder.h"

namespace fitroom::testing {
namespace {

class StoreKeeper final : public ScanKeeper {
 public:
  StoreKeeper() { Reopen(); }

  Result<ScanUpload> Start(const ScanUploadStatement& statement) override { return store_->StartUpload(statement); }
  Result<ScanUpload> Find(const ScanUpload& upload) override { return store_->FindUpload(upload.id); }
  Result<int64_t> Append(const ScanUpload& upload, int64_t offset, std::string_view bytes) override {
    return store_->AppendToUpload(upload.id, offset, bytes);
  }
  Result<ScanRecord> Finish(const ScanUpload& upload) override {
    return body_center::FinishRegistration(*store_, FakeAcceptor, upload.id, [] { return false; });
  }
  Status Drop(const ScanUpload& upload) override { return store_->DropUpload(upload.id); }
  Result<ScanRecord> Get(const ScanName& name) override { return store_->FindScan(name); }
  Result<std::vector<ScanRecord>> List(std::string_view body, int page_size) override {
    std::vector<ScanRecord> all;
    for (ScanName after;;) {
      FR_ASSIGN_OR_RETURN(const std::vector<ScanRecord> page, store_->ListScans(body, after, page_size));
      if (page.empty()) return all;
      EXPECT_LE(std::ssize(page), page_size);
      all.insert(all.end(), page.begin(), page.end());
      after = page.back().name;
    }
  }
  Result<std::string> Read(const ScanName& name, ScanContent content, int64_t offset) override {
    std::string all;
    for (;;) {
      FR_ASSIGN_OR_RETURN(const std::string part, store_->ReadContent(name, content, offset + std::ssize(all)));
      if (part.empty()) return all;
      all += part;
    }
  }
  void Reopen() override {
    store_.reset();
    Result<std::unique_ptr<body_center::BodyStore>> store = body_center::OpenSqliteBodyStore(folder_.path() / "data");
    FR_CHECK(store.ok());
    store_ = std::move(store).value();
  }

 private:
  TemporaryFolder folder_;
  std::unique_ptr<body_center::BodyStore> store_;
};

class WireKeeper final : public ScanKeeper {
 public:
  WireKeeper() { Reopen(); }

  Result<ScanUpload> Start(const ScanUploadStatement& statement) override { return client_->StartUpload(statement); }
  Result<ScanUpload> Find(const ScanUpload& upload) override { return client_->GetUpload(upload); }
  Result<int64_t> Append(const ScanUpload& upload, int64_t offset, std::string_view bytes) override {
    return client_->SendBytes(upload, offset, bytes, {});
  }
  Result<ScanRecord> Finish(const ScanUpload& upload) override {
    return client_->FinishUpload(upload, upload.statement.hash);
  }
  Status Drop(const ScanUpload& upload) override { return client_->CancelUpload(upload); }
  Result<ScanRecord> Get(const ScanName& name) override { return client_->GetScan(name); }
  Result<std::vector<ScanRecord>> List(std::string_view body, int page_size) override {
    std::vector<ScanRecord> all;
    std::string token;
    do {
      FR_ASSIGN_OR_RETURN(const remote::ScanPage page, client_->ListScans(body, page_size, token));
      EXPECT_LE(std::ssize(page.scans), page_size);
      all.insert(all.end(), page.scans.begin(), page.scans.end());
      token = page.next_page_token;
    } while (!token.empty());
    return all;
  }
  Result<std::string> Read(const ScanName& name, ScanContent content, int64_t offset) override {
    std::string all;
    FR_RETURN_IF_ERROR(client_->Download(name, content, offset, [&all](std::string_view part) {
      all += part;
      return Status();
    }));
    return all;
  }
  void Reopen() override {
    client_.reset();
    server_.reset();
    body_center::BodyServerOptions options;
    options.data_folder = folder_.path() / "data";
    options.acceptor = FakeAcceptor;
    Result<std::unique_ptr<body_center::BodyServer>> server = body_center::BodyServer::Start(options);
    FR_CHECK(server.ok());
    server_ = std::move(server).value();
    client_ = std::make_unique<remote::BodyClient>(server_->address());
  }

 private:
  TemporaryFolder folder_;
  std::unique_ptr<body_center::BodyServer> server_;
  std::unique_ptr<remote::BodyClient> client_;
};

}  // namespace

std::unique_ptr<ScanKeeper> MakeStoreKeeper() { return std::make_unique<StoreKeeper>(); }
std::unique_ptr<ScanKeeper> MakeWireKeeper() { return std::make_unique<WireKeeper>(); }

}  // namespace fitroom::testing
