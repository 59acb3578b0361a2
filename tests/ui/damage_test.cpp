/// A window that draws only what changed shows what one that draws everything does.

#include "ui/damage.h"

#include <backends/imgui_impl_opengl3.h>
#include <gtest/gtest.h>

#include <random>

#include "tests/ui/offscreen.h"
#include "ui/polygon_mesh.h"
#include "ui/texture.h"
#include "ui/window_picture.h"

namespace acentric::ui {
namespace {

constexpr int kWidth = 203, kHeight = 157;  // no multiples of a tile
constexpr Colour kBackground = Colour::hex(0x203040);

class WindowDamage : public testing::Test {
 protected:
  void SetUp() override {
    if (!screen_.works()) GTEST_SKIP() << "no OpenGL here";
    ImGui::CreateContext();
    ImGui::GetIO().IniFilename = nullptr;
    ImGui::GetIO().DisplaySize = {kWidth, kHeight};
    ASSERT_TRUE(ImGui_ImplOpenGL3_Init("#version 330 core"));
    texture_.upload(2, 1, std::vector<std::uint8_t>{255, 0, 0, 255, 0, 255, 0, 255}, false);
    const std::vector<glm::dvec2> corners{{0, 0}, {3, 0}, {2, 2}};
    mesh_.setShapes(corners, std::vector<std::uint32_t>{3});
    mesh_.setStyles(std::vector{PolygonStyle{IM_COL32(200, 80, 30, 255), IM_COL32_WHITE, 2}});
    view_.setArea({20, 30}, {100, 80});
    view_.fit({0, 0}, {3, 2});
  }
  void TearDown() override {
    if (ImGui::GetCurrentContext() == nullptr) return;
    ImGui_ImplOpenGL3_Shutdown();
    ImGui::DestroyContext();
  }
  struct Thing {
    int kind = 0;
    glm::vec2 low{0}, high{0};
    ImU32 colour = 0;
  };
  ImDrawData& frame(const std::vector<Thing>& things) {
    ImGui_ImplOpenGL3_NewFrame();
    ImGui::NewFrame();
    ImDrawList& list = *ImGui::GetForegroundDrawList();
    for (const Thing& thing : things) {
      const ImVec2 low(thing.low.x, thing.low.y), high(thing.high.x, thing.high.y);
      switch (thing.kind) {
        case 0:
          list.AddRectFilled(low, high, thing.colour, 5);
          break;
        case 1:
          list.AddText(low, thing.colour, "3.14 m");
          break;
        case 2:
          list.AddLine(low, high, thing.colour, 1.5F);
          break;
        case 3:
          list.PushClipRect({low.x + 0.4F, low.y + 0.6F}, {high.x + 0.7F, high.y + 0.2F}, true);
          list.AddImage(texture_.imguiId(), low, {high.x + 40, high.y + 40});
          list.PopClipRect();
          break;
        default:
          list.PushClipRect(low, high, true);
          mesh_.draw(list, view_, 1);
          list.PopClipRect();
          break;
      }
    }
    ImGui::Render();
    return *ImGui::GetDrawData();
  }
  static std::vector<glm::u8vec4> read(const WindowPicture& picture) {
    std::vector<glm::u8vec4> pixels(std::size_t(kWidth) * kHeight);
    glBindFramebuffer(GL_FRAMEBUFFER, picture.framebuffer());
    glReadPixels(0, 0, kWidth, kHeight, GL_RGBA, GL_UNSIGNED_BYTE, pixels.data());
    return pixels;
  }

  test::Offscreen screen_{kWidth, kHeight};
  Texture texture_;
  PolygonMesh mesh_;
  CanvasView view_;
};

TEST_F(WindowDamage, GivesTheSamePixelsAsDrawingAll) {
  std::mt19937 random(3);
  const auto below = [&](int n) { return int(random() % unsigned(n)); };
  WindowPicture kept;
  std::vector<Thing> things;
  int partly = 0;
  for (int step = 0; step < 120; ++step) {
    const int act = below(8);
    if (act < 4 || things.empty()) {
      const glm::vec2 low(below(kWidth), below(kHeight));
      things.push_back({below(4), low, low + glm::vec2(below(70), below(50)), ImU32(random()) | 0x40000000U});
      if (below(4) == 0) things.back() = {4, {25.3F, 33.8F}, {110.6F, 95.1F}, 0};
    } else if (act == 4) {
      things.erase(things.begin() + below(int(things.size())));
    } else if (act == 5) {
      things[std::size_t(below(int(things.size())))].low += glm::vec2(0.5F, 0.25F);
    } else if (act == 6) {
      const auto red = std::uint8_t(below(256));
      texture_.upload(2, 1, std::vector<std::uint8_t>{red, 0, 0, 255, 0, 255, 0, 255}, false);
    } else {
      view_.panPixels({below(5), below(5)});
    }
    // A canvas is drawn once a frame.
    for (std::size_t i = 0, seen = 0; i < things.size(); ++i)
      if (things[i].kind == 4 && seen++ > 0) things.erase(things.begin() + std::ptrdiff_t(i--));
    const bool drawn = kept.draw(frame(things), kBackground);
    partly += drawn ? 1 : 0;
    WindowPicture fresh;
    ASSERT_TRUE(fresh.draw(frame(things), kBackground));
    ASSERT_EQ(read(kept), read(fresh)) << "step " << step;
    EXPECT_FALSE(kept.draw(frame(things), kBackground)) << "nothing changed";
  }
  EXPECT_GT(partly, 60);
}

TEST_F(WindowDamage, IsSmallForASmallChange) {
  Damage damage;
  std::vector<Thing> things{{0, {3, 3}, {190, 150}, IM_COL32_WHITE}, {0, {40, 40}, {50, 50}, IM_COL32_BLACK}};
  const std::vector<PixelRect> all{{{0, 0}, {kWidth, kHeight}}};
  EXPECT_EQ(damage.update(frame(things)), all);
  EXPECT_TRUE(damage.update(frame(things)).empty());
  things[1].colour = IM_COL32(255, 0, 0, 255);
  EXPECT_EQ(damage.update(frame(things)), (std::vector<PixelRect>{{{32, 32}, {64, 64}}}));
  damage.forget();
  EXPECT_EQ(damage.update(frame(things)), all);
}

TEST_F(WindowDamage, KeepsTheOrderOfWhatLiesOverEachOther) {
  Damage damage;
  std::vector<Thing> things{{0, {0, 0}, {20, 20}, IM_COL32_WHITE}, {0, {0, 0}, {20, 20}, IM_COL32_BLACK}};
  damage.update(frame(things));
  std::swap(things[0], things[1]);
  EXPECT_EQ(damage.update(frame(things)), (std::vector<PixelRect>{{{0, 0}, {32, 32}}}));
}

TEST_F(WindowDamage, OfManyPlacesIsOneRectangle) {
  Damage damage;
  std::vector<Thing> things;
  damage.update(frame(things));
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      things.push_back({0, {70 * i + 1, 64 * j + 1}, {70 * i + 5, 64 * j + 5}, IM_COL32_WHITE});
  EXPECT_EQ(damage.update(frame(things)), (std::vector<PixelRect>{{{0, 0}, {160, 157}}}));
}

}  // namespace
}  // namespace acentric::ui
