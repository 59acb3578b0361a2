#include "ui/mark_mesh.h"

#include <epoxy/gl.h>

#include "ui/vertex_layout.h"

namespace acentric::ui {
namespace {

struct Instance {
  glm::vec2 place;   // metres from the tile's origin
  glm::vec2 sector;  // low and width, radians
  std::uint32_t mark;
};
static_assert(sizeof(Instance) == 20);

constexpr float kSectorFill = 0.22F, kSectorLine = 0.8F;  // opacities

}  // namespace

void MarkMesh::setPlaces(std::span<const CanvasMark> marks) {
  std::vector<CanvasBox> boxes;
  boxes.reserve(marks.size());
  for (const CanvasMark& mark : marks) boxes.push_back({mark.place, mark.place});
  tiles_ = tilesOf(boxes);
  std::vector<Instance> data;
  data.reserve(marks.size());
  for (const CanvasTile& tile : tiles_.tiles)
    for (std::uint32_t n = tile.first; n < tile.first + tile.count; ++n) {
      const CanvasMark& mark = marks[tiles_.order[n]];
      data.push_back(
          {glm::vec2(mark.place - tile.origin), {mark.lowRadians, mark.widthRadians}, tiles_.order[n]});
    }
  ContentHash hash;
  hash.add(marks);
  places_ = hash.value();
  glBindVertexArray(array_.made());
  uploadTo(data_, GL_ARRAY_BUFFER, data.data(), data.size() * sizeof(Instance));
  for (const unsigned place : {0U, 1U, 2U}) {
    glEnableVertexAttribArray(place);
    glVertexAttribDivisor(place, 1);
  }
  glBindVertexArray(0);
}

void MarkMesh::renderWith(GlProgram& program, const CanvasView& view, const CanvasTarget& target,
                          const MarkLook& look, float radius) {
  if (!program.use()) return;
  program.set("uRadius", radius);
  program.set("uOpacity", look.opacity);
  program.set("uRim", look.rim.x, look.rim.y, look.rim.z, look.rim.w);
  program.set("uFill", kSectorFill);
  program.set("uLine", kSectorLine);
  forVisibleTiles(program, view, target, tiles_, double(radius) + 1, [&](std::size_t t) {
    const std::size_t at = tiles_.tiles[t].first * sizeof(Instance);
    const auto stride = GLsizei(sizeof(Instance));
    glVertexAttribPointer(0, 2, GL_FLOAT, GL_FALSE, stride, offset(at));
    glVertexAttribPointer(1, 2, GL_FLOAT, GL_FALSE, stride, offset(at + sizeof(glm::vec2)));
    glVertexAttribIPointer(2, 1, GL_UNSIGNED_INT, stride, offset(at + 2 * sizeof(glm::vec2)));
    glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, GLsizei(tiles_.tiles[t].count));
  });
}

void MarkMesh::render(const CanvasView& view, const CanvasTarget& target, const MarkLook& look) {
  if (empty() || table_.empty() || !(look.opacity > 0)) return;
  table_.bind();
  glBindVertexArray(array_.name());
  glBindBuffer(GL_ARRAY_BUFFER, data_.name());
  if (look.sectorPixels > 0) renderWith(sector_, view, target, look, look.sectorPixels);
  if (look.dotPixels > 0) renderWith(dot_, view, target, look, look.dotPixels + 1);
  glBindVertexArray(0);
}

void MarkMesh::draw(ImDrawList& list, const CanvasView& view, const MarkLook& look) {
  if (empty() || !(look.opacity > 0)) return;
  ContentHash hash;
  hash.add(places_);
  hash.add(table_.content());
  hash.add(look);
  addView(hash, view);
  pending_ = {[this, view, look](const CanvasTarget& target) { render(view, target, look); }, hash.value()};
  addRender(list, &pending_);
}

const std::string& MarkMesh::problem() const {
  return dot_.problem().empty() ? sector_.problem() : dot_.problem();
}

}  // namespace acentric::ui
