/// Two bakes of one project, a model that changes under a bake, and light that is baked in parts.

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <functional>
#include <future>
#include <thread>

#include "engine/base/file.h"
#include "engine/pipeline/bake_guard.h"
#include "engine/pipeline/project_lock.h"
#include "tests/end_to_end/sample_project.h"

namespace acentric::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

/// Files of the captures' folder with this extension that are whole.
std::vector<fs::path> filesOf(const SampleProject& project, const std::string& extension) {
  std::vector<fs::path> files;
  std::error_code error;
  for (fs::directory_iterator entry(project.captures(), error), end; !error && entry != end;
       entry.increment(error))
    if (entry->path().extension() == extension && entry->path().filename().string().front() != '.')
      files.push_back(entry->path());
  return files;
}

/// Waits for an event of a program that runs; false once the program has ended.
bool waitWhileRunning(std::future<ProcessResult>& program, const std::function<bool()>& event) {
  while (!event())
    if (program.wait_for(std::chrono::milliseconds(1)) == std::future_status::ready) return event();
  return true;
}

std::future<ProcessResult> start(std::vector<std::string> arguments) {
  return std::async(std::launch::async, [arguments = std::move(arguments)] { return acentric(arguments); });
}

TEST(SecondBake, OfAProjectIsRefusedUnlessItTakesTheFirstOver) {
  const SampleProject project("second-bake");
  ASSERT_EQ(project.made().exitCode, 0) << project.made().errors;
  auto running = start({"bake", project.file(), "--threads", "1"});
  const fs::path lock = project.file() + ".bake.lock";
  ASSERT_TRUE(waitWhileRunning(running, [&] { return !filesOf(project, ".pack").empty(); }));
  const auto owner = readLock(project.file() + ".bake");
  ASSERT_TRUE(owner.has_value()) << owner.error().describe();
  const auto process = pid_t(owner->process);

  ASSERT_EQ(::kill(process, SIGSTOP), 0);  // else it may end meanwhile
  const auto second = acentric({"bake", project.file()});
  EXPECT_EQ(second.exitCode, 1);
  EXPECT_THAT(second.errors, HasSubstr("is being baked by"));
  EXPECT_THAT(second.errors, HasSubstr(std::to_string(owner->process)));
  EXPECT_THAT(second.errors, HasSubstr(owner->host));
  EXPECT_THAT(second.errors, HasSubstr("--take-over"));
  EXPECT_EQ(acentric({"bake", project.file(), "--shard", "1/2"}).exitCode, 1);
  EXPECT_EQ(acentric({"bake", project.file(), "--dry-run"}).exitCode, 0) << "looking is allowed";

  EXPECT_EQ(::kill(process, SIGCONT), 0);
  const auto taken = acentric({"bake", project.file(), "--take-over", "--json"});
  EXPECT_EQ(taken.exitCode, 0) << taken.errors;
  EXPECT_GT(Json::parse(taken.output)["reused"].get<int>(), 0);
  const ProcessResult first = running.get();
  EXPECT_EQ(first.exitCode, 1);
  EXPECT_THAT(first.errors, HasSubstr("taken over by"));
  EXPECT_FALSE(fs::exists(lock));
  EXPECT_EQ(acentric({"validate", project.file()}).exitCode, 0);
}

TEST(ChangedModel, EndsTheBakeWhichSaysWhatWasKeptAndTheNextOneBakesItAsItIs) {
  const SampleProject project("changed-model", "-3,-3;3,-3;3,3;-3,3");
  ASSERT_EQ(project.made().exitCode, 0) << project.made().errors;
  const fs::path model = project.folder() / "gallery.glb";
  const auto original = readFile(model);
  ASSERT_TRUE(original.has_value());
  auto changed = *original;  // one colour, in the text that the file begins with
  const std::string_view text(reinterpret_cast<const char*>(changed.data()), changed.size());
  const std::size_t fraction = text.find("0.", text.find("baseColorFactor\":["));
  ASSERT_NE(fraction, std::string_view::npos);
  const std::size_t at = fraction + 2;  // within 0..1, where another digit is another colour
  changed[at] = std::byte(text[at] == '1' ? '2' : '1');

  auto running = start({"bake", project.file(), "--threads", "1"});
  ASSERT_TRUE(waitWhileRunning(running, [&] { return !filesOf(project, ".record").empty(); }));
  ASSERT_TRUE(writeFileAtomically(model, changed));
  const ProcessResult ended = running.get();
  EXPECT_EQ(ended.exitCode, 1) << ended.output;
  EXPECT_THAT(ended.errors, HasSubstr("gallery.glb"));
  EXPECT_THAT(ended.errors, HasSubstr("changed while it was baked"));
  EXPECT_THAT(ended.errors, HasSubstr("are kept"));
  EXPECT_THAT(ended.errors, HasSubstr("bake again"));
  const std::size_t kept = filesOf(project, ".pack").size();
  EXPECT_GE(kept, 1u);

  const auto next = acentric({"bake", project.file(), "--json"});
  ASSERT_EQ(next.exitCode, 0) << next.errors;
  EXPECT_EQ(Json::parse(next.output)["reused"], 0);
  ASSERT_TRUE(writeFileAtomically(model, *original));
  const auto back = acentric({"bake", project.file(), "--json"});
  ASSERT_EQ(back.exitCode, 0) << back.errors;
  EXPECT_EQ(Json::parse(back.output)["reused"], kept) << "what was kept is of the model as it was";
}

TEST(KilledLight, GoesOnWhereItWasToTheSameBytes) {
  const SampleProject project("killed-light");
  ASSERT_EQ(project.made().exitCode, 0) << project.made().errors;
  Json json = project.read();
  json["bake"]["surfaceTexel"] = 0.1;
  project.write(json);
  const std::vector<std::string> bake = {"bake", project.file(), "--light", "only", "--threads",
                                         "1",    "--json"};
  const auto whole = acentric(bake);
  ASSERT_EQ(whole.exitCode, 0) << whole.errors;
  EXPECT_EQ(Json::parse(whole.output)["surfaceLight"]["resumedSamples"], 0);
  ASSERT_EQ(filesOf(project, ".light").size(), 1u);
  EXPECT_TRUE(filesOf(project, ".part").empty()) << "parts go when the light is whole";
  const auto expected = readFile(filesOf(project, ".light").front());
  fs::remove_all(project.captures());

  auto running = start(bake);
  ASSERT_TRUE(waitWhileRunning(running, [&] { return !filesOf(project, ".part").empty(); }));
  const auto owner = readLock(project.file() + ".bake-light");
  ASSERT_TRUE(owner.has_value());
  ASSERT_EQ(::kill(pid_t(owner->process), SIGKILL), 0);
  EXPECT_EQ(running.get().signal, SIGKILL);
  ASSERT_TRUE(filesOf(project, ".light").empty());
  ASSERT_FALSE(filesOf(project, ".part").empty());

  const auto next = acentric(bake);
  ASSERT_EQ(next.exitCode, 0) << next.errors;
  EXPECT_GT(Json::parse(next.output)["surfaceLight"]["resumedSamples"].get<int>(), 0);
  ASSERT_EQ(filesOf(project, ".light").size(), 1u);
  EXPECT_EQ(*readFile(filesOf(project, ".light").front()), *expected);
  EXPECT_TRUE(filesOf(project, ".part").empty());
}

}  // namespace
}  // namespace acentric::test
