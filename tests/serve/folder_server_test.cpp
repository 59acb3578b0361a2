/// What the local server sends, and what it does not, asked by a real client.

#include "engine/serve/folder_server.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <httplib.h>
#include <unistd.h>

#include <atomic>
#include <thread>

#include "engine/base/file.h"
#include "engine/base/stopwatch.h"

namespace acentric {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class FolderServerTest : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::path(testing::TempDir()) / ("serve-" + std::to_string(::getpid()));
    put("site/index.html", "<p>page");
    put("site/deep/a b.pack", "0123456789");
    put("site/bundle.json", std::string(5000, ' ') + "{}");
    put("site/empty.pack", "");
    put("secret.txt", "secret");
    put("page/index.html", "<p>viewer");
    put("page/viewer.js", "walk()");
    put("kitchen 2.acentric", "walk");
    fs::create_symlink("../secret.txt", folder_ / "site/out.txt");
    fs::create_symlink("..", folder_ / "site/up");
    fs::create_symlink("index.html", folder_ / "site/within.html");
  }
  void TearDown() override { fs::remove_all(folder_); }

  void put(const std::string& name, const std::string& text) {
    fs::create_directories((folder_ / name).parent_path());
    ASSERT_TRUE(writeTextAtomically(folder_ / name, text));
  }
  void serve(const std::string& subject, const fs::path& page = {}) {
    ServeOptions options{folder_ / subject, page, 0, [this](const PageLoad&) { ++loads_; }};
    auto started = FolderServer::start(options);
    ASSERT_TRUE(started) << started.error().describe();
    server_ = std::move(*started);
  }
  httplib::Result get(const std::string& path, const httplib::Headers& headers = {}) const {
    httplib::Client client("127.0.0.1", server_->port());
    client.set_decompress(false);
    return client.Get(path, headers);
  }
  int statusOf(const std::string& path, const httplib::Headers& headers = {}) const {
    const auto answer = get(path, headers);
    return answer ? answer->status : -1;
  }
  std::string part(const std::string& range) const {
    const auto answer = get("/deep/a%20b.pack", {{"Range", range}});
    if (!answer) return "none";
    return std::to_string(answer->status) + " " + answer->body + " " +
           answer->get_header_value("Content-Range");
  }

  fs::path folder_;
  std::unique_ptr<FolderServer> server_;
  std::atomic<int> loads_ = 0;
};

TEST_F(FolderServerTest, SendsWhatLiesInTheFolderAlsoByLinksWithinIt) {
  serve("site");
  EXPECT_EQ(server_->address(), "http://127.0.0.1:" + std::to_string(server_->port()) + "/");
  for (const char* path : {"/", "/index.html", "/within.html", "/?any=thing"}) {
    const auto answer = get(path);
    ASSERT_TRUE(answer) << path;
    EXPECT_EQ(answer->body, "<p>page");
    EXPECT_EQ(answer->get_header_value("Content-Type"), "text/html; charset=utf-8");
    EXPECT_EQ(answer->get_header_value("Cache-Control"), "no-store");
  }
  EXPECT_EQ(get("/deep/a%20b.pack")->body, "0123456789");
  EXPECT_EQ(get("/empty.pack")->body, "");
  EXPECT_EQ(statusOf("/deep/"), 404);
  EXPECT_EQ(statusOf("/deep"), 404);
  EXPECT_EQ(statusOf("/none"), 404);
}

TEST_F(FolderServerTest, SendsNothingFromOutside) {
  serve("site");
  for (const char* path :
       {"/out.txt", "/up/secret.txt", "/../secret.txt", "/%2e%2e/secret.txt", "/..%2fsecret.txt",
        "/deep/../../secret.txt", "//etc/passwd", "/%2Fetc%2Fpasswd", "/index.html%00.txt", "/up"})
    EXPECT_EQ(statusOf(path), 404) << path;
}

TEST_F(FolderServerTest, SendsRangesOfFiles) {
  serve("site");
  EXPECT_EQ(part("bytes=1-2"), "206 12 bytes 1-2/10");
  EXPECT_EQ(part("bytes=7-"), "206 789 bytes 7-9/10");
  EXPECT_EQ(part("bytes=7-90"), "206 789 bytes 7-9/10");
  EXPECT_EQ(part("bytes=-2"), "206 89 bytes 8-9/10");
  EXPECT_EQ(part("bytes=-90"), "206 0123456789 bytes 0-9/10");
  EXPECT_EQ(part("bytes=10-11"), "416  bytes */10");
  EXPECT_EQ(part("bytes=-0"), "416  bytes */10");
  EXPECT_EQ(part("bytes=3-2"), "416  ");
  EXPECT_EQ(part("bytes=0-1,4-5"), "200 0123456789 ");
  EXPECT_EQ(get("/bundle.json", {{"Range", "bytes=5000-5001"}, {"Accept-Encoding", "gzip"}})->body, "{}");
  EXPECT_EQ(statusOf("/empty.pack", {{"Range", "bytes=0-0"}}), 416);
}

TEST_F(FolderServerTest, CompressesTextForThoseThatReadItSo) {
  serve("site");
  const auto plain = get("/bundle.json");
  EXPECT_EQ(plain->body.size(), 5002u);
  EXPECT_FALSE(plain->has_header("Content-Encoding"));
  const auto packed = get("/bundle.json", {{"Accept-Encoding", "br, gzip, zstd"}});
  EXPECT_EQ(packed->get_header_value("Content-Encoding"), "gzip");
  EXPECT_LT(packed->body.size(), 200u);
  EXPECT_FALSE(get("/deep/a%20b.pack", {{"Accept-Encoding", "gzip"}})->has_header("Content-Encoding"));
}

TEST_F(FolderServerTest, AnswersGetAndHeadAloneAndToThisMachinesNamesAlone) {
  serve("site");
  httplib::Client client("127.0.0.1", server_->port());
  const auto head = client.Head("/deep/a%20b.pack");
  ASSERT_TRUE(head);
  EXPECT_EQ(head->get_header_value("Content-Length"), "10");
  EXPECT_EQ(head->body, "");
  for (const auto& answer : {client.Post("/", "x", "text/plain"), client.Put("/new.txt", "x", "text/plain"),
                             client.Delete("/index.html"), client.Options("/")}) {
    ASSERT_TRUE(answer);
    EXPECT_EQ(answer->status, 405);
  }
  EXPECT_TRUE(fs::exists(folder_ / "site/index.html"));
  EXPECT_EQ(statusOf("/", {{"Host", "localhost:8000"}}), 200);
  EXPECT_EQ(statusOf("/", {{"Host", "evil.example"}}), 403);
  EXPECT_EQ(statusOf("/", {{"Host", "127.0.0.1.evil.example"}}), 403);
}

TEST_F(FolderServerTest, IsReachedOnTheLoopbackAlone) {
  serve("site");
  // Of 127.0.0.0/8 all is this machine, and but one address is listened on.
  httplib::Client other("127.0.0.2", server_->port());
  other.set_connection_timeout(2);
  EXPECT_FALSE(other.Get("/"));
}

TEST_F(FolderServerTest, ServesOneWalkWithThePage) {
  serve("kitchen 2.acentric", folder_ / "page");
  EXPECT_THAT(server_->address(), HasSubstr("/?walk=kitchen%202.acentric"));
  EXPECT_EQ(get("/?walk=kitchen%202.acentric")->body, "<p>viewer");
  EXPECT_EQ(get("/viewer.js")->body, "walk()");
  EXPECT_EQ(get("/kitchen%202.acentric")->body, "walk");
  EXPECT_EQ(get("/kitchen%202.acentric", {{"Range", "bytes=1-2"}})->body, "al");
  EXPECT_EQ(statusOf("/secret.txt"), 404) << "lies beside it";
}

TEST_F(FolderServerTest, TakesThePageOnlyForWhatTheFolderLacks) {
  serve("site", folder_ / "page");
  EXPECT_EQ(get("/")->body, "<p>page");
  EXPECT_EQ(get("/viewer.js")->body, "walk()");
}

TEST_F(FolderServerTest, TellsWhatAPageTookUntilItsFirstFrame) {
  serve("site");
  get("/deep/a%20b.pack");
  EXPECT_EQ(statusOf(std::string(kReportPath) + "?ms=100"), 204);
  EXPECT_TRUE(server_->lastLoad());
  EXPECT_EQ(server_->reportingAddress(), server_->address() + "?report");
  get("/?report");
  EXPECT_FALSE(server_->lastLoad()) << "it has just begun";
  get("/deep/a%20b.pack");
  get("/deep/a%20b.pack", {{"Range", "bytes=0-3"}});
  EXPECT_EQ(statusOf(std::string(kReportPath) + "?ms=1250"), 204);
  get("/deep/a%20b.pack");
  EXPECT_EQ(server_->lastLoad(), (PageLoad{1.25, 7 + 10 + 4, 3}));
  EXPECT_EQ(loads_, 2);
  for (const char* wrong : {"?ms=-1", "?ms=nan", "?ms=1e99"}) statusOf(std::string(kReportPath) + wrong);
  EXPECT_EQ(server_->lastLoad()->seconds, 1.25);
}

TEST_F(FolderServerTest, APortThatIsTakenIsRefusedAndASubjectThatIsNotThere) {
  serve("site");
  const auto second = FolderServer::start({folder_ / "site", {}, server_->port(), {}});
  ASSERT_FALSE(second);
  EXPECT_THAT(second.error().describe(), HasSubstr(std::to_string(server_->port())));
  EXPECT_FALSE(FolderServer::start({folder_ / "none", {}, 0, {}}));
}

TEST_F(FolderServerTest, StopsWhileConnectionsAreOpenAndIsGoneThen) {
  put("site/large.pack", std::string(std::size_t(64) << 20, 'x'));
  serve("site");
  const int port = server_->port();
  httplib::Client idle("127.0.0.1", port);
  idle.set_keep_alive(true);
  ASSERT_TRUE(idle.Get("/"));
  std::atomic<bool> begun = false;
  std::thread slow([&] {
    httplib::Client client("127.0.0.1", port);
    const auto answer = client.Get("/large.pack", [&](const char*, std::size_t) {
      begun = true;
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
      return true;
    });
    EXPECT_FALSE(answer) << "it was not sent to its end";
  });
  while (!begun) std::this_thread::yield();
  const Stopwatch watch;
  server_.reset();
  EXPECT_LT(watch.seconds(), 5);
  slow.join();
  httplib::Client after("127.0.0.1", port);
  after.set_connection_timeout(2);
  EXPECT_FALSE(after.Get("/"));
}

}  // namespace
}  // namespace acentric
