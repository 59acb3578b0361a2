/// Publishing in a session: a room is baked, published and served to a real client.

#include "editor/session/publish.h"

#include <gmock/gmock.h>
#include <httplib.h>

#include <map>

#include "editor/actions/action_table.h"
#include "engine/base/file.h"
#include "engine/export/bundle.h"
#include "tests/editor/session_fixture.h"

namespace acentric::editor {
namespace {

using testing::HasSubstr;

class PublishTest : public SessionTest {
 protected:
  void SetUp() override {
    SessionTest::SetUp();
    write(folder_ / "page/index.html", "<title>Acentric walk</title><main></main>");
    write(folder_ / "page/viewer.js", "walk()");
    write(folder_ / "page/viewer.css", "p {}");
    SessionOptions given = options();
    given.page = folder_ / "page";
    session_.emplace(given);
    openAndSettle(*session_, folder_ / "room.obj");
    makeCoarse(*session_);
    settle();
  }
  void TearDown() override {
    session_.reset();
    SessionTest::TearDown();
  }
  static void write(const fs::path& file, const std::string& text) {
    fs::create_directories(file.parent_path());
    ASSERT_TRUE(writeTextAtomically(file, text));
  }

  Publisher& publishing() { return session_->publishing(); }
  void settle() {
    waitFor(*session_, [&] { return !session_->working(); });
  }
  void bake() {
    session_->startBake();
    settle();
  }
  /// Where nothing is, without a browser.
  PublishPlace place(bool oneFile = false) const { return {folder_ / "out", oneFile, false}; }
  void publish(const PublishPlace& where, bool allowMissing = false, const std::string& expected = {}) {
    session_->publish(where, allowMissing);
    waitFor(
        *session_, [&] { return !session_->working(); }, expected);
  }
  int port() {
    const std::string address = publishing().address();
    return std::stoi(address.substr(address.rfind(':') + 1));
  }
  httplib::Result get(const std::string& path, const httplib::Headers& headers = {}) {
    httplib::Client client("127.0.0.1", port());
    client.set_decompress(false);
    return client.Get(path, headers);
  }
  static std::map<std::string, std::string> filesIn(const fs::path& folder) {
    std::map<std::string, std::string> files;
    for (const auto& entry : fs::recursive_directory_iterator(folder))
      if (entry.is_regular_file())
        files[fs::relative(entry.path(), folder).string()] = *readText(entry.path());
    return files;
  }
  std::vector<std::string> leftovers() const {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder_))
      if (entry.path().filename().string().starts_with(kTemporaryPrefix))
        names.push_back(entry.path().filename().string());
    return names;
  }

  std::optional<Session> session_;
};

TEST_F(PublishTest, WritesServesAndTellsWhatItIs) {
  bake();
  publish(place());
  const auto& published = publishing().published();
  ASSERT_TRUE(published) << publishing().trouble();
  const auto files = filesIn(folder_ / "out");
  std::uint64_t bytes = 0;
  for (const auto& [name, text] : files) bytes += text.size();
  EXPECT_EQ(published->report.bytes, bytes);
  EXPECT_EQ(published->report.files, files.size());
  EXPECT_GT(published->report.bundle.fullBytes, 0u);
  EXPECT_FALSE(published->again);
  EXPECT_TRUE(told(*session_, publishing().address()));

  ASSERT_TRUE(publishing().serving());
  EXPECT_EQ(get("/")->body, files.at("index.html"));
  EXPECT_EQ(get("/bundle.json")->body, files.at("bundle.json"));
  EXPECT_EQ(get("/bundle.json", {{"Range", "bytes=1-4"}})->body, files.at("bundle.json").substr(1, 4));
  EXPECT_EQ(get("/../room.obj")->status, 404);
  EXPECT_EQ(get("/%2e%2e/editor.json")->status, 404);
}

TEST_F(PublishTest, ThatReplacesKeepsItsAddressAndWhatIsTheSame) {
  bake();
  publish(place());
  const std::string address = publishing().address();
  Project brighter = session_->project();
  brighter.bookmarks.push_back({"corner", 0, {0.5, 0.5, 1.6}, 0, 0, 70});
  ASSERT_TRUE(session_->apply({brighter, "Add a bookmark"}));
  settle();
  publish(place());
  ASSERT_TRUE(publishing().published());
  EXPECT_TRUE(publishing().published()->again);
  const BundleReport& report = publishing().published()->report.bundle;
  EXPECT_EQ(report.reused, report.cameras);
  EXPECT_EQ(publishing().address(), address);
  EXPECT_THAT(get("/bundle.json")->body, HasSubstr("corner"));
  EXPECT_TRUE(leftovers().empty());
}

TEST_F(PublishTest, AsOneFileIsServedByRanges) {
  bake();
  publish(place(true));
  ASSERT_TRUE(publishing().published()) << publishing().trouble();
  const fs::path walk = publishing().published()->report.walk;
  EXPECT_EQ(walk, folder_ / "out" / "room.acentric");
  const auto part = get("/room.acentric", {{"Range", "bytes=0-99"}});
  EXPECT_EQ(part->status, 206);
  EXPECT_EQ(part->body, readText(walk)->substr(0, 100));
  EXPECT_THAT(get("/")->body, HasSubstr("acentric-walk\" content=\"room.acentric\""));
}

TEST_F(PublishTest, AsksWhereNotAllIsBakedAndWritesNothingThen) {
  publish(place(), true);
  ASSERT_TRUE(publishing().gaps());
  EXPECT_TRUE(publishing().gaps()->all()) << "nothing at all: there is nothing to go on with";
  EXPECT_FALSE(fs::exists(folder_ / "out"));

  bake();
  Project more = session_->project();
  more.layout().outline.loops.front()[2] += glm::dvec2(0.6, 0.6);
  more.layout().cellSize = 2;
  ASSERT_TRUE(session_->apply({more, "Other cells"}));
  settle();
  session_->startBake();
  waitFor(*session_, [&] { return session_->bakeQueue().finished() > 0 || !session_->baking().running(); });
  session_->cancelBake();
  settle();
  publish(place());
  ASSERT_TRUE(publishing().gaps());
  EXPECT_TRUE(publishing().gaps()->any());
  EXPECT_FALSE(publishing().published());
  EXPECT_FALSE(fs::exists(folder_ / "out"));
  publish(place(), true);
  EXPECT_FALSE(publishing().gaps());
  ASSERT_TRUE(publishing().published()) << publishing().trouble();
  EXPECT_TRUE(fs::exists(folder_ / "out" / kBundleIndex));
}

TEST_F(PublishTest, ThatIsCancelledLeavesNothingHalfWritten) {
  bake();
  publish(place());
  const auto before = filesIn(folder_ / "out");
  Project brighter = session_->project();
  brighter.exposure = 2;
  ASSERT_TRUE(session_->apply({brighter, "Brighter"}));
  settle();
  for (const char* const stage : {"", "writing"}) {
    session_->publish(place(), true);
    waitFor(*session_, [&] {
      return !publishing().job().running() || publishing().job().progress().stage.find(stage) == 0;
    });
    publishing().cancel();
    settle();
    EXPECT_EQ(filesIn(folder_ / "out"), before) << stage;
    EXPECT_TRUE(leftovers().empty()) << stage;
  }
  EXPECT_TRUE(told(*session_, "cancelled"));
  EXPECT_EQ(get("/bundle.json")->body, before.at("bundle.json")) << "it is still served";
}

TEST_F(PublishTest, ThatFailsSaysWhyAndTheWayOut) {
  bake();
  write(folder_ / "mine/letter.txt", "dear");
  publish({folder_ / "mine", false, false}, false, "Publishing failed");
  EXPECT_THAT(publishing().trouble(), HasSubstr("letter.txt"));
  EXPECT_EQ(*readText(folder_ / "mine/letter.txt"), "dear");
  fs::remove(folder_ / "page/viewer.js");
  publish(place(), false, "Publishing failed");
  EXPECT_THAT(publishing().trouble(), HasSubstr("viewer.js"));
  EXPECT_FALSE(publishing().published());
  EXPECT_FALSE(publishing().serving());
  EXPECT_FALSE(fs::exists(folder_ / "out"));
}

TEST_F(PublishTest, IsServedUntilItIsStoppedOrTheProjectIsClosed) {
  bake();
  publish(place());
  const int first = port();
  publishing().stopServing();
  EXPECT_FALSE(publishing().serving());
  const auto gone = [&](int at) {
    httplib::Client client("127.0.0.1", at);
    return !client.Get("/");
  };
  waitFor(*session_, [&] { return gone(first); });
  publishing().serve();
  const int second = port();
  EXPECT_EQ(get("/")->status, 200);
  session_->close();
  EXPECT_FALSE(publishing().published());
  waitFor(*session_, [&] { return gone(second); });
}

TEST_F(PublishTest, TellsThePagesFirstFrameAndGivesLinks) {
  bake();
  publish(place());
  const std::string body = get("/?report")->body;
  EXPECT_FALSE(publishing().lastLoad());
  get(std::string(kReportPath) + "?ms=2500");
  EXPECT_TRUE(session_->poll(now_)) << "what is shown is another";
  EXPECT_EQ(publishing().lastLoad(), (PageLoad{2.5, body.size(), 1}));

  EditorState state;
  state.walker.standAt({{1.234, -0.5, 1.6}, 3.14159265 / 2, -0.1});
  ActionContext context{*session_, state};
  const auto table = makeActionTable();
  const auto run = [&](const char* id) {
    const Action& action = *findAction(table, std::string(id));
    EXPECT_TRUE(action.enabled(context)) << id;
    action.run(context);
  };
  run("publish.copyView");
  EXPECT_EQ(state.toClipboard, publishing().address() + "#at=1.23,-0.50,90.0,-5.7&storey=0");
  run("publish.copyStart");
  EXPECT_EQ(state.toClipboard, publishing().address());
  PublishPlace known = session_->publishPlace();
  known.publicAddress = "https://example.org/walk/";
  session_->keepPublishPlace(known);
  run("publish.copyView");
  EXPECT_EQ(state.toClipboard, "https://example.org/walk/#at=1.23,-0.50,90.0,-5.7&storey=0");
  session_->keepPublishPlace(place());
  run("publish.stop");
  EXPECT_FALSE(findAction(table, std::string("publish.copyView"))->enabled(context));
}

TEST(PublicAddress, IsThatOfAPage) {
  EXPECT_EQ(checkPublicAddress("").value(), "");
  EXPECT_EQ(checkPublicAddress("https://example.org/a/#at=1,2,3,4").value(), "https://example.org/a/");
  EXPECT_EQ(checkPublicAddress("http://a/index.html?walk=b.acentric").value(),
            "http://a/index.html?walk=b.acentric");
  for (const char* wrong : {"example.org", "https://", "javascript:alert(1)", "https://a b/", "file:///etc"})
    EXPECT_FALSE(checkPublicAddress(wrong)) << wrong;
}

TEST_F(PublishTest, RemembersWhereAProjectIsPublished) {
  EXPECT_EQ(session_->publishPlace(), (PublishPlace{folder_ / "room-web", false, true})) << "beside it";
  bake();
  publish(place(true));
  EXPECT_EQ(session_->publishPlace(), place(true));
  session_.emplace(options());
  openAndSettle(*session_, folder_ / "room.obj");
  EXPECT_EQ(session_->publishPlace(), place(true));
}

}  // namespace
}  // namespace acentric::editor
