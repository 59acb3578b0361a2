/// The C library over a bundle: loading in the background, and models for a client's own renderer.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstring>
#include <mutex>
#include <set>
#include <span>
#include <thread>

#include "engine/base/file.h"
#include "engine/capi/acentric_runtime.h"
#include "tests/export/small_walk.h"

namespace acentric {
namespace {

namespace fs = std::filesystem;

/// Files of a folder, some of which cannot be had, behind a door that can be shut.
struct GatedFolder {
  fs::path folder;
  std::mutex door;  ///< shut while it is locked
  std::atomic<int> reads{0};
  std::mutex mutex;
  std::set<std::string> gone;

  acentric_files files() {
    acentric_files files;
    files.user = this;
    files.size = [](void* user, const char* name, std::uint64_t* bytes) -> acentric_status {
      auto& from = *static_cast<GatedFolder*>(user);
      { const std::lock_guard through(from.door); }
      const std::lock_guard lock(from.mutex);
      if (from.gone.contains(name)) return ACENTRIC_ERROR_NOT_FOUND;
      *bytes = fs::file_size(from.folder / name);
      return ACENTRIC_OK;
    };
    files.read = [](void* user, const char* name, void* into, std::uint64_t bytes) -> acentric_status {
      auto& from = *static_cast<GatedFolder*>(user);
      ++from.reads;
      const auto file = readFile(from.folder / name, 1 << 30);
      if (!file || file->size() != bytes) return ACENTRIC_ERROR_UNREADABLE;
      std::memcpy(into, file->data(), bytes);
      return ACENTRIC_OK;
    };
    return files;
  }
};

class CapiBackground : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    room = fs::temp_directory_path() / ("acentric-capi-background-" + std::to_string(::getpid()));
    fs::create_directories(room);
    TaskRunner runner(1);
    const OpenProject project = test::bakedProject(room / "walk.acentric.json", runner);
    const auto written = exportBundle({&project, 1}, room / "bundle", {false, "", kLosslessColours}, runner);
    ASSERT_TRUE(written) << written.error().describe();
  }
  static void TearDownTestSuite() { fs::remove_all(room); }
  void SetUp() override {
    from.folder = room / "bundle";
    const acentric_files files = from.files();
    ASSERT_EQ(acentric_open_files(&files, &bundle), ACENTRIC_OK) << acentric_message(bundle);
    ASSERT_EQ(acentric_set_threads(bundle, 2), ACENTRIC_OK);
    ASSERT_EQ(acentric_start_view(bundle, &view), ACENTRIC_OK);
    view.width = 160, view.height = 100;
  }
  void TearDown() override { acentric_close(bundle); }

  std::vector<std::uint8_t> draw() {
    std::vector<std::uint8_t> rgba(std::size_t(view.width) * std::size_t(view.height) * 4);
    const acentric_picture picture{rgba.data(), 0, nullptr, nullptr};
    EXPECT_EQ(acentric_render(bundle, &view, nullptr, &picture), ACENTRIC_OK) << acentric_message(bundle);
    return rgba;
  }
  std::vector<acentric_need> needs() {
    std::vector<acentric_need> list(100);
    acentric_needs all;
    EXPECT_EQ(acentric_view_needs(bundle, &view, nullptr, list.data(), list.size(), &all), ACENTRIC_OK);
    list.resize(all.count);
    return list;
  }
  /// Until all has come; what polling said that was not right.
  std::vector<std::string> pollAll() {
    std::vector<std::string> errors;
    while (acentric_waiting(bundle) > 0) {
      if (acentric_poll(bundle, nullptr) != ACENTRIC_OK) errors.emplace_back(acentric_message(bundle));
      std::this_thread::yield();
    }
    return errors;
  }
  std::vector<acentric_arrival> takeAll() {
    std::vector<acentric_arrival> all;
    while (acentric_waiting(bundle) > 0) {
      acentric_arrival next;
      EXPECT_EQ(acentric_next_model(bundle, &next), ACENTRIC_OK) << acentric_message(bundle);
      if (next.model != nullptr)
        all.push_back(next);
      else
        std::this_thread::yield();
    }
    return all;
  }

  static inline fs::path room;
  GatedFolder from;
  acentric_bundle* bundle = nullptr;
  acentric_view view;
};

TEST_F(CapiBackground, LoadsWhatAViewNeedsWithoutEverWaiting) {
  from.door.lock();
  ASSERT_EQ(acentric_request_view(bundle, &view, nullptr, ACENTRIC_FULL), ACENTRIC_OK);
  EXPECT_GT(acentric_waiting(bundle), 6) << "coarse ones, what is near, full ones";
  std::int32_t arrived = -1;
  EXPECT_EQ(acentric_poll(bundle, &arrived), ACENTRIC_OK);
  EXPECT_EQ(arrived, 0);
  const auto empty = draw();
  from.door.unlock();
  EXPECT_TRUE(pollAll().empty());
  for (const acentric_need& need : needs()) EXPECT_EQ(need.loaded, ACENTRIC_FULL) << need.number;
  const auto full = draw();
  EXPECT_NE(full, empty);
  ASSERT_EQ(acentric_load_view(bundle, &view, nullptr, ACENTRIC_FULL), ACENTRIC_OK);
  EXPECT_EQ(draw(), full) << "nothing was left to load";
  ASSERT_EQ(acentric_request_view(bundle, &view, nullptr, ACENTRIC_FULL), ACENTRIC_OK);
  EXPECT_EQ(acentric_waiting(bundle), 0);
}

TEST_F(CapiBackground, CancelDropsWhatWasNotBegun) {
  from.reads = 0;
  from.door.lock();
  ASSERT_EQ(acentric_request_view(bundle, &view, nullptr, ACENTRIC_FULL), ACENTRIC_OK);
  ASSERT_EQ(acentric_cancel(bundle), ACENTRIC_OK);
  EXPECT_LE(acentric_waiting(bundle), 2) << "one a thread is under way";
  from.door.unlock();
  pollAll();
  EXPECT_LE(from.reads, 2);
}

TEST_F(CapiBackground, ClosesWhileItLoads) {
  ASSERT_EQ(acentric_request_view(bundle, &view, nullptr, ACENTRIC_FULL), ACENTRIC_OK);
  ASSERT_EQ(acentric_request_models(bundle, &view, nullptr, 1024), ACENTRIC_OK);
}

TEST_F(CapiBackground, NamesAFileThatCannotBeHadOnceAndGoesOn) {
  for (const auto& entry : fs::directory_iterator(from.folder / "regions"))
    from.gone.insert("regions/" + entry.path().filename().string());
  ASSERT_EQ(acentric_request_view(bundle, &view, nullptr, ACENTRIC_FULL), ACENTRIC_OK);
  const auto errors = pollAll();
  ASSERT_EQ(errors.size(), 1u) << "once, and what is near the region alone";
  EXPECT_NE(errors.back().find("regions/"), std::string::npos) << errors.back();
  ASSERT_EQ(acentric_request_view(bundle, &view, nullptr, ACENTRIC_FULL), ACENTRIC_OK);
  EXPECT_EQ(acentric_waiting(bundle), 0) << "what failed is not tried again";
  {
    const std::lock_guard lock(from.mutex);
    from.gone.clear();
  }
  ASSERT_EQ(acentric_cancel(bundle), ACENTRIC_OK);
  ASSERT_EQ(acentric_request_view(bundle, &view, nullptr, ACENTRIC_FULL), ACENTRIC_OK);
  EXPECT_TRUE(pollAll().empty());
  for (const acentric_need& need : needs()) EXPECT_EQ(need.loaded, ACENTRIC_FULL) << need.number;
}

TEST_F(CapiBackground, UnloadsWhatAViewDoesNotNeed) {
  acentric_storey storey;
  ASSERT_EQ(acentric_get_storey(bundle, 0, &storey), ACENTRIC_OK);
  for (int camera = 0; camera < storey.cameras; ++camera)
    ASSERT_EQ(acentric_load_capture(bundle, 0, camera, ACENTRIC_COARSE), ACENTRIC_OK);
  for (int region = 0; region < storey.regions; ++region)
    ASSERT_EQ(acentric_load_region(bundle, 0, region), ACENTRIC_OK);
  ASSERT_EQ(acentric_load_view(bundle, &view, nullptr, ACENTRIC_FULL), ACENTRIC_OK);
  const auto frame = draw();
  const std::uint64_t all = acentric_memory(bundle);
  ASSERT_EQ(acentric_unload_beyond(bundle, &view, nullptr, all), ACENTRIC_OK);
  EXPECT_EQ(acentric_memory(bundle), all);
  ASSERT_EQ(acentric_unload_beyond(bundle, &view, nullptr, all - 1), ACENTRIC_OK);
  const std::uint64_t less = acentric_memory(bundle);
  EXPECT_LT(less, all);
  ASSERT_EQ(acentric_unload_beyond(bundle, &view, nullptr, 0), ACENTRIC_OK);
  EXPECT_LT(acentric_memory(bundle), less) << "only as much as was asked for, before";
  EXPECT_EQ(draw(), frame);
}

/// Arrays of a model fit each other.
void expectSound(const acentric_model& model) {
  std::uint64_t indices = 0;
  for (const acentric_mesh& mesh : std::span(model.meshes, std::size_t(model.mesh_count))) {
    EXPECT_EQ(mesh.first_index, indices);
    EXPECT_GT(mesh.index_count, 0u);
    EXPECT_EQ(mesh.index_count % 3, 0u);
    indices += mesh.index_count;
    EXPECT_TRUE(mesh.texture >= 0 && mesh.texture < model.texture_count);
    EXPECT_NE(mesh.roles, 0u);
    EXPECT_EQ(mesh.alpha_cutoff > 0, mesh.alpha_mode == ACENTRIC_MASK);
    EXPECT_STRNE(mesh.name, "");
  }
  EXPECT_EQ(indices, model.index_count);
  for (const std::uint32_t index : std::span(model.indices, model.index_count))
    ASSERT_LT(index, model.vertex_count);
  for (const acentric_model_vertex& vertex : std::span(model.vertices, model.vertex_count))
    for (const float value :
         {vertex.position[0], vertex.position[1], vertex.position[2], vertex.uv[0], vertex.uv[1]})
      ASSERT_TRUE(std::isfinite(value));
  for (const acentric_image& image : std::span(model.textures, std::size_t(model.texture_count))) {
    EXPECT_GT(image.width * image.height, 0);
    EXPECT_NE(image.rgba, nullptr);
  }
}

TEST_F(CapiBackground, ModelsComeOnceCoarseOnesFirstAndOutliveTheHandle) {
  ASSERT_EQ(acentric_request_models(bundle, &view, nullptr, 1024), ACENTRIC_OK);
  const auto models = takeAll();
  std::set<int> coarse, full, regions;
  for (const acentric_arrival& each : models) {
    expectSound(*each.model);
    if (each.kind == ACENTRIC_REGION)
      regions.insert(each.number);
    else if (each.detail == ACENTRIC_FULL)
      full.insert(each.number);
    else
      coarse.insert(each.number);
  }
  EXPECT_EQ(models.size(), coarse.size() + full.size() + regions.size()) << "each once";
  EXPECT_EQ(regions.size(), 1u);
  EXPECT_EQ(full.size(), std::set<int>(full).size());
  for (const acentric_need& need : needs())
    EXPECT_TRUE((need.kind == ACENTRIC_CAPTURE ? full : regions).contains(need.number)) << need.number;
  EXPECT_LE(coarse.size(), full.size());
  EXPECT_EQ(acentric_memory(bundle), 0u) << "models are their users'";

  ASSERT_EQ(acentric_request_models(bundle, &view, nullptr, 1024), ACENTRIC_OK);
  EXPECT_EQ(acentric_waiting(bundle), 0) << "all are in use";
  const auto some = std::ranges::find(models, ACENTRIC_FULL, &acentric_arrival::detail);
  ASSERT_NE(some, models.end());
  ASSERT_EQ(acentric_return_model(bundle, &*some), ACENTRIC_OK);
  ASSERT_EQ(acentric_request_models(bundle, &view, nullptr, 1024), ACENTRIC_OK);
  const auto again = takeAll();
  ASSERT_FALSE(again.empty());
  EXPECT_EQ(again.back().number, some->number);
  EXPECT_EQ(again.back().model->vertex_count, some->model->vertex_count);

  acentric_close(bundle);
  bundle = nullptr;
  for (const auto& list : {models, again})
    for (const acentric_arrival& each : list) {
      expectSound(*each.model);
      acentric_free_model(each.model);
    }
}

TEST_F(CapiBackground, ACaptureIsMadeOfMeshesByRoles) {
  const acentric_need need = needs().front();
  ASSERT_EQ(need.kind, ACENTRIC_CAPTURE);
  const acentric_model* model = nullptr;
  ASSERT_EQ(acentric_make_model(bundle, 0, ACENTRIC_CAPTURE, need.number, ACENTRIC_FULL, 512, &model),
            ACENTRIC_OK)
      << acentric_message(bundle);
  expectSound(*model);
  std::uint64_t wanted = 0, others = 0;
  for (const acentric_mesh& mesh : std::span(model->meshes, std::size_t(model->mesh_count)))
    ((mesh.roles & need.roles) != 0 ? wanted : others) += mesh.index_count;
  EXPECT_GT(wanted, 0u);
  EXPECT_GT(others, 0u) << "other regions see other sides";
  for (const acentric_image& image : std::span(model->textures, std::size_t(model->texture_count)))
    EXPECT_LE(std::max(image.width, image.height), 512);
  acentric_camera camera;
  ASSERT_EQ(acentric_get_camera(bundle, 0, need.number, &camera), ACENTRIC_OK);
  EXPECT_EQ(model->origin[0], camera.position[0]);
  acentric_free_model(model);
}

TEST_F(CapiBackground, TheMatrixPutsWhatIsAheadInTheMiddle) {
  view.yaw = 0.7, view.pitch = -0.2;
  const double origin[3] = {view.eye[0] + 3, view.eye[1] - 2, 0.5};
  float m[16];
  acentric_clip_from_model(&view, origin, 0.1, m);
  const auto clip = [&](double x, double y, double z) {
    const double at[4] = {x - origin[0], y - origin[1], z - origin[2], 1};
    std::array<double, 4> out{};
    for (int row = 0; row < 4; ++row)
      for (int column = 0; column < 4; ++column)
        out[std::size_t(row)] += double(m[4 * column + row]) * at[column];
    return out;
  };
  const double flat = 5 * std::cos(view.pitch);
  const auto ahead = clip(view.eye[0] + flat * std::cos(view.yaw), view.eye[1] + flat * std::sin(view.yaw),
                          view.eye[2] + 5 * std::sin(view.pitch));
  EXPECT_NEAR(ahead[0], 0, 1e-5);
  EXPECT_NEAR(ahead[1], 0, 1e-5);
  EXPECT_NEAR(ahead[3], 5, 1e-5);
  EXPECT_NEAR(ahead[2], 5 - 0.2, 1e-5) << "-1 at ten centimetres, 1 at infinity";
  const double edge = view.yaw - view.fov / 2;
  view.pitch = 0;
  acentric_clip_from_model(&view, origin, 0.1, m);
  const auto right = clip(view.eye[0] + std::cos(edge), view.eye[1] + std::sin(edge), view.eye[2]);
  EXPECT_NEAR(right[0] / right[3], 1, 1e-5) << "the right border";
  EXPECT_NEAR(right[1], 0, 1e-5);
  EXPECT_GT(clip(view.eye[0] + std::cos(view.yaw), view.eye[1] + std::sin(view.yaw), view.eye[2] + 0.1)[1],
            0);
}

TEST_F(CapiBackground, RefusesWhatIsWrong) {
  constexpr acentric_status kWrong = ACENTRIC_ERROR_ARGUMENT;
  const acentric_model* model = nullptr;
  acentric_arrival arrival{};
  EXPECT_EQ(acentric_request_view(nullptr, &view, nullptr, ACENTRIC_FULL), kWrong);
  EXPECT_EQ(acentric_request_view(bundle, nullptr, nullptr, ACENTRIC_FULL), kWrong);
  EXPECT_EQ(acentric_request_view(bundle, &view, nullptr, 0), kWrong);
  EXPECT_EQ(acentric_request_models(bundle, nullptr, nullptr, 1024), kWrong);
  EXPECT_EQ(acentric_request_models(bundle, &view, nullptr, 127), kWrong);
  EXPECT_EQ(acentric_request_models(bundle, &view, nullptr, 16385), kWrong);
  EXPECT_EQ(acentric_poll(nullptr, nullptr), kWrong);
  EXPECT_EQ(acentric_poll(bundle, nullptr), ACENTRIC_OK);
  EXPECT_EQ(acentric_next_model(bundle, nullptr), kWrong);
  EXPECT_EQ(acentric_next_model(bundle, &arrival), ACENTRIC_OK);
  EXPECT_EQ(arrival.model, nullptr);
  EXPECT_EQ(acentric_return_model(bundle, nullptr), kWrong);
  EXPECT_EQ(acentric_waiting(nullptr), 0);
  EXPECT_EQ(acentric_unload_beyond(bundle, nullptr, nullptr, 0), kWrong);
  EXPECT_EQ(acentric_make_model(bundle, 0, ACENTRIC_CAPTURE, 0, ACENTRIC_FULL, 1024, nullptr), kWrong);
  EXPECT_EQ(acentric_make_model(bundle, 1, ACENTRIC_CAPTURE, 0, ACENTRIC_FULL, 1024, &model), kWrong);
  EXPECT_EQ(acentric_make_model(bundle, 0, 7, 0, ACENTRIC_FULL, 1024, &model), kWrong);
  EXPECT_EQ(acentric_make_model(bundle, 0, ACENTRIC_CAPTURE, -1, ACENTRIC_FULL, 1024, &model), kWrong);
  EXPECT_EQ(acentric_make_model(bundle, 0, ACENTRIC_CAPTURE, 0, ACENTRIC_ABSENT, 1024, &model), kWrong);
  EXPECT_EQ(acentric_make_model(bundle, 0, ACENTRIC_REGION, 1 << 30, 0, 1024, &model), kWrong);
  EXPECT_EQ(model, nullptr);
  acentric_free_model(nullptr);
  view.eye[0] = 90;
  EXPECT_EQ(acentric_request_view(bundle, &view, nullptr, ACENTRIC_FULL), ACENTRIC_ERROR_OUTSIDE);
  EXPECT_EQ(acentric_request_models(bundle, &view, nullptr, 1024), ACENTRIC_ERROR_OUTSIDE);
}

}  // namespace
}  // namespace acentric
