#pragma once
/// A session without a window, on a real model in a folder of its own.

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <functional>
#include <optional>
#include <thread>

#include "editor/commands/layout_edits.h"
#include "editor/commands/setting_edits.h"
#include "editor/session/session.h"

namespace acentric::editor {

namespace fs = std::filesystem;

/// A closed room 6 x 5 x 3 m, Y up, faces inwards.
inline void writeRoom(const fs::path& file) {
  std::ofstream(file) << "v -3 0 -2.5\nv 3 0 -2.5\nv 3 0 2.5\nv -3 0 2.5\n"
                         "v -3 3 -2.5\nv 3 3 -2.5\nv 3 3 2.5\nv -3 3 2.5\n"
                         "f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";
}

class SessionTest : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("acentric_session_" + std::to_string(::getpid()));
    fs::remove_all(folder_);
    fs::create_directories(folder_);
    writeModel(folder_ / "room.obj");
  }
  void TearDown() override { fs::remove_all(folder_); }
  virtual void writeModel(const fs::path& file) { writeRoom(file); }

  SessionOptions options() const {
    SessionOptions options;
    options.importHost.importer = ACENTRIC_IMPORTER;
    options.program = fs::path(ACENTRIC_IMPORTER).parent_path() / "acentric";
    options.importHost.cacheFolder = folder_ / "cache";
    options.preferencesFile = folder_ / "editor.json";
    options.processors = 2;
    options.autosaveSeconds = 0;
    return options;
  }
  /// Lets jobs work until `done`; fails after five minutes, and on errors that are told, but for `expected`
  /// ones.
  void waitFor(Session& session, const std::function<bool()>& done, const std::string& expected = {}) {
    for (int i = 0; i < 60000 && !done(); ++i) {
      session.poll(now_);
      now_ += 0.05;
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    for (const Message& message : session.messages().all())
      if (message.level == MessageLevel::error &&
          (expected.empty() || message.text.find(expected) == std::string::npos))
        ADD_FAILURE() << message.text;
    ASSERT_TRUE(done());
  }
  void openAndSettle(Session& session, const fs::path& file) {
    session.open(file);
    waitFor(session, [&] { return session.walk() && !session.working(); });
  }
  static bool told(const Session& session, const std::string& text) {
    auto& messages = const_cast<Session&>(session).messages();
    return std::ranges::any_of(
        messages.all(), [&](const Message& message) { return message.text.find(text) != std::string::npos; });
  }
  /// Coarse, so that a bake takes a moment.
  static void makeCoarse(Session& session) {
    BakeSettings bake = session.project().bake;
    bake.samplesPerDegree = 0.5;
    bake.ambientRays = 0;
    bake.surfaceTexel = 0.5;
    session.apply(setBakeSettings(session.project(), bake, "coarse"));
    session.apply(setCellSize(session.project(), 2.5));
  }
  /// The room as a project that is laid out and not baked.
  void saveCoarseRoom(Session& session) {
    openAndSettle(session, folder_ / "room.obj");
    makeCoarse(session);
    ASSERT_TRUE(session.saveAs(folder_ / "room.acentric.json"));
    waitFor(session, [&] { return !session.working() && session.built()->project == session.project(); });
  }

  fs::path folder_;
  double now_ = 0;
};

/// With one session that has the room open.
class OpenSessionTest : public SessionTest {
 protected:
  void SetUp() override {
    SessionTest::SetUp();
    session_.emplace(options());
    openAndSettle(*session_, folder_ / "room.obj");
  }
  void TearDown() override {
    session_.reset();
    SessionTest::TearDown();
  }
  void waitFor(const std::function<bool()>& done) { SessionTest::waitFor(*session_, done); }

  std::optional<Session> session_;
};

}  // namespace acentric::editor
