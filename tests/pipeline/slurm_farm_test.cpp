#include "engine/pipeline/slurm_farm.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <memory>

#include "engine/pipeline/shard.h"

namespace acentric {
namespace {

using testing::HasSubstr;
using testing::Not;

/// What a real shell makes of a script.
std::string outputOf(const std::string& command) {
  const std::unique_ptr<FILE, int (*)(FILE*)> pipe(::popen(command.c_str(), "r"), &::pclose);
  std::string output;
  std::array<char, 256> buffer{};
  while (std::fgets(buffer.data(), int(buffer.size()), pipe.get())) output += buffer.data();
  return output;
}

FarmOptions sound() {
  FarmOptions options;
  options.program = "/opt/a b/acentric";
  options.project = "/srv/it's \"here\"/$HOME/x.acentric.json";
  options.scenes = "/srv/it's \"here\"/$HOME/x.farm/scenes";
  options.cameraTasks = 7;
  options.nodes = 3;
  return options;
}

TEST(ShellQuoted, IsOneWordThatTheShellGivesBack) {
  for (const std::string text :
       {"plain", "two words", "it's", "a\"b", "$HOME `date` \\ *", "new\nline", "-n", ""})
    EXPECT_EQ(outputOf("printf %s " + shellQuoted(text)), text);
}

TEST(FarmTasks, AreEachWorthTheLeastTime) {
  EXPECT_EQ(farmTasks(0, 0, 30), 0);
  EXPECT_EQ(farmTasks(3, 50, 30), 1);
  EXPECT_EQ(farmTasks(89, 50, 30), 2);
  EXPECT_EQ(farmTasks(90, 50, 30), 3);
  EXPECT_EQ(farmTasks(1e4, 50, 30), 50) << "a task has a camera at least";
  EXPECT_EQ(farmTasks(1e12, 1'000'000, 30), kMostFarmTasks);
}

TEST(SlurmScripts, RunTheirShareWithPathsUnharmed) {
  const FarmScripts scripts = slurmScripts(sound());
  // The program is replaced by one that prints its arguments, one a line.
  const auto run = [](std::string script, const std::string& task) {
    const std::string program = shellQuoted("/opt/a b/acentric");
    script.replace(script.find(program), program.size(), "printf '%s\\n'");
    return outputOf("SLURM_CPUS_ON_NODE=5 SLURM_ARRAY_TASK_ID=" + task + " bash -c " + shellQuoted(script));
  };
  const std::string start =
      "bake\n/srv/it's \"here\"/$HOME/x.acentric.json\n--import-cache\n/srv/it's "
      "\"here\"/$HOME/x.farm/scenes\n"
      "--threads\n5\n--take-over\n";
  EXPECT_EQ(run(scripts.bake, "3"), start + "--light\nwithout\n--shard\n3/7\n");
  EXPECT_EQ(run(scripts.bake, "0"), start + "--light\nonly\n");
  EXPECT_EQ(run(scripts.merge, "0"), start + "--verify\n");
  EXPECT_TRUE(parseShard("3/7"));
}

TEST(SlurmScripts, SayWhatSlurmNeedsToKnow) {
  FarmOptions options = sound();
  EXPECT_THAT(slurmScripts(options).bake, HasSubstr("#SBATCH --array=0-7%3\n"));
  EXPECT_THAT(slurmScripts(options).bake, HasSubstr("#SBATCH --requeue\n"));
  EXPECT_THAT(slurmScripts(options).bake, HasSubstr("#SBATCH --exclusive\n"));
  EXPECT_THAT(slurmScripts(options).bake, Not(HasSubstr("--partition")));
  options.light = false;
  options.threads = 12;
  options.partition = "night";
  options.storey = "first floor";
  const FarmScripts scripts = slurmScripts(options);
  EXPECT_THAT(scripts.bake, HasSubstr("#SBATCH --array=1-7%3\n"));
  for (const std::string& script : {scripts.bake, scripts.merge}) {
    EXPECT_THAT(script, HasSubstr("#SBATCH --cpus-per-task=12\n"));
    EXPECT_THAT(script, HasSubstr("#SBATCH --partition=night\n"));
    EXPECT_THAT(script, HasSubstr("--storey 'first floor'"));
  }
}

TEST(SlurmScripts, TryAgainWhenEndedBySignalOnly) {
  const auto attempts = [](const std::string& end) {
    std::string script = slurmScripts(sound()).merge;
    const std::string program = shellQuoted("/opt/a b/acentric");
    script.replace(script.find(program), program.size(), "bash -c 'echo once; " + end + "' x");
    return outputOf("bash -c " + shellQuoted(script) + " 2>/dev/null; echo $?");
  };
  EXPECT_EQ(attempts("exit 0"), "once\n0\n");
  EXPECT_EQ(attempts("exit 2"), "once\n2\n");
  EXPECT_EQ(attempts("kill -9 $$"), "once\nonce\nonce\n137\n");
}

TEST(FarmOptions, ThatMakeNoSenseAreRefused) {
  EXPECT_TRUE(sound().check());
  const auto refused = [](auto change) {
    FarmOptions options = sound();
    change(options);
    return !options.check();
  };
  EXPECT_TRUE(refused([](FarmOptions& o) { o.nodes = 0; }));
  EXPECT_TRUE(refused([](FarmOptions& o) { o.threads = -1; }));
  EXPECT_TRUE(refused([](FarmOptions& o) { o.cameraTasks = kMostFarmTasks + 1; }));
  EXPECT_TRUE(refused([](FarmOptions& o) { o.cameraTasks = 0, o.light = false; }));
  EXPECT_TRUE(refused([](FarmOptions& o) { o.partition = "a\n#SBATCH --wrap=x"; }));
  EXPECT_TRUE(refused([](FarmOptions& o) { o.project = "here.acentric.json"; }));
  EXPECT_TRUE(refused([](FarmOptions& o) { o.scenes.clear(); }));
}

}  // namespace
}  // namespace acentric
