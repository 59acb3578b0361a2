/// importScene with its child process: cache, damage, cancelling, crashes, limits.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <fstream>
#include <thread>

#include "tests/scene/scene_fixtures.h"

namespace acentric::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class ImportProcess : public testing::Test {
 protected:
  ImportProcess() {
    host.importer = ACENTRIC_IMPORTER;
    host.cacheFolder = folder.path() / "cache";
    host.timeLimitSeconds = 30;
    builder.triangle();
    builder.primitive()["material"] = 0;
    builder.primitive()["attributes"]["TEXCOORD_0"] = builder.vec2({0, 0, 1, 0, 0, 1});
    builder.json["textures"] = {{{"source", 0}}};
    builder.json["images"] = {{{"uri", "paint.png"}}};
    builder.json["materials"] = {{{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}};
    paint({255, 0, 0, 255});
    model = builder.write(folder.path() / "model.gltf");
  }

  void paint(Rgba8 colour) {
    EXPECT_TRUE(writeColourImage(ColourImage(1, 1, colour), folder.path() / "paint.png"));
  }

  ScenePtr import() {
    auto scene = importScene(model, {}, host);
    EXPECT_TRUE(scene) << scene.error().describe();
    return scene ? *scene : nullptr;
  }
  /// With a shell script in the importer's place.
  Error refusalOf(const std::string& script, std::stop_token stop = {}) {
    const fs::path program = folder.path() / "importer.sh";
    std::ofstream(program) << "#!/bin/sh\n" << script << "\n";
    fs::permissions(program, fs::perms::owner_all);
    host.importer = program;
    const auto scene = importScene(model, {}, host, {}, std::move(stop));
    EXPECT_FALSE(scene);
    EXPECT_EQ(entries(), 0) << "something was left in the cache folder";
    return scene ? Error{} : scene.error();
  }
  int entries() const {
    int count = 0;
    for (const auto& entry : fs::directory_iterator(host.cacheFolder)) {
      if (entry.path().extension() == ".last") continue;  // what a path was last imported to
      EXPECT_EQ(entry.path().extension(), ".acscene");
      EXPECT_FALSE(entry.path().filename().string().starts_with(kTemporaryPrefix));
      ++count;
    }
    return count;
  }

  TemporaryFolder folder{"import_process"};
  GltfBuilder builder;
  ImportHost host;
  fs::path model;
};

TEST_F(ImportProcess, TheSecondOpenNeedsNoImporter) {
  const ScenePtr first = import();
  ASSERT_TRUE(first);
  EXPECT_EQ(entries(), 1);
  host.importer = "/nonexistent";
  const ScenePtr second = import();
  ASSERT_TRUE(second);
  EXPECT_EQ(second->key, first->key);
  EXPECT_EQ(second->report.found, first->report.found);
  // The same bytes under another name beside the same files.
  fs::copy_file(model, folder.path() / "copy.gltf");
  model = folder.path() / "copy.gltf";
  EXPECT_EQ(import()->name, "copy");
}

TEST_F(ImportProcess, AnotherMachineTakesAnImportedSceneFromAFolderThatItOnlyReads) {
  const ScenePtr first = import();
  const fs::path shared = folder.path() / "shared";
  ASSERT_TRUE(shareImported(model, {}, host, shared));
  paint({0, 255, 0, 255});
  const ScenePtr green = import();
  ASSERT_NE(green->key, first->key);
  ASSERT_TRUE(shareImported(model, {}, host, shared)) << "what was shared of the model as it was is replaced";
  fs::permissions(shared, fs::perms::owner_read | fs::perms::owner_exec);
  host.importer = "/nonexistent";
  host.cacheFolder = shared;
  const ScenePtr taken = import();
  ASSERT_TRUE(taken);
  EXPECT_EQ(taken->key, green->key);
  EXPECT_TRUE(taken->meshes[0].positions.isMapped());
  fs::permissions(shared, fs::perms::owner_all);
}

TEST_F(ImportProcess, AChangedTextureOrOptionIsImportedAfresh) {
  const ScenePtr red = import();
  paint({0, 255, 0, 255});
  const ScenePtr green = import();
  EXPECT_NE(green->key, red->key);
  EXPECT_EQ(green->images[0]->pixels[0], Rgba8(0, 255, 0, 255));
  fs::remove(folder.path() / "paint.png");
  EXPECT_TRUE(import()->images.empty());
  paint({0, 255, 0, 255});
  EXPECT_EQ(import()->key, green->key);
  EXPECT_EQ(entries(), 1);
  auto scaled = importScene(model, {2, UpAxis::guess, true}, host);
  ASSERT_TRUE(scaled);
  EXPECT_NE((*scaled)->key, green->key);
  EXPECT_EQ(entries(), 2);
}

TEST_F(ImportProcess, AModelThatIsGoneIsKnownAsItWasLastImported) {
  EXPECT_EQ(lastImported(model, {}, host), nullptr);
  import();
  paint({0, 255, 0, 255});
  const ScenePtr green = import();
  fs::remove(model);
  EXPECT_FALSE(importScene(model, {}, host));
  const ScenePtr last = lastImported(model, {}, host);
  ASSERT_TRUE(last);
  EXPECT_EQ(last->key, green->key);
  EXPECT_EQ(last->name, model.stem());
  EXPECT_EQ(lastImported(model, {2, UpAxis::guess, true}, host), nullptr) << "never imported like this";
  for (const auto& entry : fs::directory_iterator(host.cacheFolder))
    if (entry.path().extension() == ".last") std::ofstream(entry.path()) << "../../etc/passwd";
  EXPECT_EQ(lastImported(model, {}, host), nullptr);
}

TEST_F(ImportProcess, ADamagedCacheEntryIsMadeAgain) {
  const ContentKey key = import()->key;
  for (const auto& entry : fs::directory_iterator(host.cacheFolder))
    fs::resize_file(entry.path(), fs::file_size(entry.path()) / 2);
  EXPECT_EQ(import()->key, key);
  host.importer = "/nonexistent";
  EXPECT_EQ(import()->key, key);
}

TEST_F(ImportProcess, WithoutCacheNothingIsKept) {
  host.useCache = false;
  ASSERT_TRUE(import());
  EXPECT_EQ(entries(), 0);
}

TEST_F(ImportProcess, ACrashIsTold) {
  const Error error = refusalOf("kill -SEGV $$");
  EXPECT_EQ(error.kind, ErrorKind::malformed);
  EXPECT_THAT(error.describe(), HasSubstr("model.gltf: the importer crashed (signal 11)"));
}

TEST_F(ImportProcess, AHangIsEndedInTime) {
  host.timeLimitSeconds = 0.3;
  const auto start = std::chrono::steady_clock::now();
  const Error error = refusalOf("exec sleep 60");
  EXPECT_EQ(error.kind, ErrorKind::timeout);
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(10));
}

TEST_F(ImportProcess, MemoryIsWatched) {
  host.memoryLimitBytes = std::size_t(64) << 20;
  const Error error = refusalOf("exec tail /dev/zero");  // keeps a line that never ends
  EXPECT_EQ(error.kind, ErrorKind::outOfSpace);
  EXPECT_THAT(error.message, HasSubstr("64 MiB"));
}

TEST_F(ImportProcess, WhatTakesMoreMemoryThanItMayIsRefusedBeforeItIsRead) {
  builder.json["accessors"].push_back({{"componentType", 5125}, {"count", 300'000'000}, {"type", "SCALAR"}});
  builder.primitive()["indices"] = builder.json["accessors"].size() - 1;
  model = builder.write(folder.path() / "heavy.gltf");
  host.memoryLimitBytes = std::size_t(1) << 30;
  const auto scene = importScene(model, {}, host);
  ASSERT_FALSE(scene);
  EXPECT_EQ(scene.error().kind, ErrorKind::tooLarge);
  EXPECT_THAT(scene.error().describe(), HasSubstr("heavy.gltf: has 100,000,000 triangles"));
  EXPECT_THAT(scene.error().message, HasSubstr("1.0 GB may be taken"));
  EXPECT_THAT(scene.error().message, HasSubstr("--import-memory"));
}

TEST_F(ImportProcess, CancellingStopsTheImporter) {
  std::stop_source stop;
  const std::jthread later([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    stop.request_stop();
  });
  EXPECT_EQ(refusalOf("touch \"$3\"; exec sleep 60", stop.get_token()).kind, ErrorKind::cancelled);
}

TEST_F(ImportProcess, AnImporterThatSaysNothingOrLiesIsNotBelieved) {
  EXPECT_THAT(refusalOf("exit 3").message, HasSubstr("exit code 3"));
  EXPECT_THAT(refusalOf("exit 0").message, HasSubstr("gave up"));
  EXPECT_THAT(refusalOf("echo garbage > \"$3\"; echo '{\"written\":true}'").message,
              HasSubstr("broken scene"));
  EXPECT_THAT(refusalOf("head -c 300000 /dev/zero; echo "
                        "'{\"error\":{\"kind\":\"tooLarge\",\"message\":\"m\",\"where\":\"w\"}}'")
                  .message,
              HasSubstr("gave up"));
  EXPECT_EQ(refusalOf("echo '{\"error\":{\"kind\":\"tooLarge\",\"message\":\"m\",\"where\":\"w\"}}'; exit 1")
                .describe(),
            "w: m");
}

TEST_F(ImportProcess, AMissingImporterAndAMissingModelAreTold) {
  host.importer = folder.path() / "none";
  const auto scene = importScene(model, {}, host);
  ASSERT_FALSE(scene);
  EXPECT_THAT(scene.error().describe(), HasSubstr("none: the importer program is missing"));
  EXPECT_EQ(importScene(folder.path() / "absent.glb", {}, host).error().kind, ErrorKind::notFound);
}

TEST_F(ImportProcess, ProgressArrives) {
  host.useCache = false;
  std::vector<std::string> stages;
  ASSERT_TRUE(
      importScene(model, {}, host, [&](const ProgressState& state) { stages.push_back(state.stage); }));
  EXPECT_THAT(stages, testing::Contains("reading the file"));
}

}  // namespace
}  // namespace acentric::test
