#include "ui/polygon_mesh.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <bit>

#include "ui/vertex_layout.h"

namespace acentric::ui {
namespace {

struct Corner {
  glm::vec2 at;  // metres from the tile's origin
  std::uint32_t polygon;
};
struct Edge {
  glm::vec2 from, to;
  std::uint32_t polygon;
};
static_assert(sizeof(Corner) == 12 && sizeof(Edge) == 20);

void word(unsigned place, std::size_t stride, std::size_t at) {
  glVertexAttribIPointer(place, 1, GL_UNSIGNED_INT, GLsizei(stride), offset(at));
}

}  // namespace

void PolygonMesh::setShapes(std::span<const glm::dvec2> corners, std::span<const std::uint32_t> ends) {
  const auto firstOf = [&](std::size_t p) { return p == 0 ? std::uint32_t(0) : ends[p - 1]; };
  std::vector<CanvasBox> boxes;
  boxes.reserve(ends.size());
  for (std::size_t p = 0; p < ends.size(); ++p) {
    CanvasBox box{corners[firstOf(p)], corners[firstOf(p)]};
    for (std::uint32_t c = firstOf(p); c < ends[p]; ++c)
      box.low = glm::min(box.low, corners[c]), box.high = glm::max(box.high, corners[c]);
    boxes.push_back(box);
  }
  tiles_ = tilesOf(boxes);
  triangles_.clear();
  edges_.clear();
  std::vector<Corner> cornerData;
  std::vector<std::uint32_t> indices;
  std::vector<Edge> edges;
  cornerData.reserve(corners.size());
  edges.reserve(corners.size());
  indices.reserve(3 * corners.size());
  for (const CanvasTile& tile : tiles_.tiles) {
    const std::size_t firstIndex = indices.size(), firstEdge = edges.size();
    for (std::uint32_t n = tile.first; n < tile.first + tile.count; ++n) {
      const std::uint32_t polygon = tiles_.order[n], first = firstOf(polygon);
      const std::uint32_t size = ends[polygon] - first;
      const auto base = std::uint32_t(cornerData.size());
      const auto local = [&](std::uint32_t k) { return glm::vec2(corners[first + k % size] - tile.origin); };
      for (std::uint32_t k = 0; k < size; ++k) {
        cornerData.push_back({local(k), polygon});
        edges.push_back({local(k), local(k + 1), polygon});
        if (k >= 2) indices.insert(indices.end(), {base, base + k - 1, base + k});
      }
    }
    triangles_.push_back({firstIndex, indices.size() - firstIndex});
    edges_.push_back({firstEdge, edges.size() - firstEdge});
  }
  ContentHash hash;
  hash.add(corners);
  hash.add(ends);
  shapes_ = hash.value();
  glBindVertexArray(fillArray_.made());
  uploadTo(corners_, GL_ARRAY_BUFFER, cornerData.data(), cornerData.size() * sizeof(Corner));
  uploadTo(indices_, GL_ELEMENT_ARRAY_BUFFER, indices.data(), indices.size() * sizeof(std::uint32_t));
  floats(0, 2, sizeof(Corner), 0);
  word(1, sizeof(Corner), sizeof(glm::vec2));
  glEnableVertexAttribArray(0);
  glEnableVertexAttribArray(1);
  glBindVertexArray(lineArray_.made());
  uploadTo(edgeData_, GL_ARRAY_BUFFER, edges.data(), edges.size() * sizeof(Edge));
  for (const unsigned place : {0U, 1U, 2U}) {
    glEnableVertexAttribArray(place);
    glVertexAttribDivisor(place, 1);
  }
  glBindVertexArray(0);
}

void PolygonMesh::setStyles(std::span<const PolygonStyle> styles) {
  std::vector<std::uint32_t> words;
  words.reserve(3 * styles.size());
  widestLine_ = 1;
  anyFill_ = false;
  for (const PolygonStyle& style : styles) {
    words.insert(words.end(), {style.fill, style.line, std::bit_cast<std::uint32_t>(style.linePixels)});
    widestLine_ = std::max(widestLine_, double(style.linePixels));
    anyFill_ = anyFill_ || (style.fill & IM_COL32_A_MASK) != 0;
  }
  table_.upload(words);
}

void PolygonMesh::renderFills(const CanvasView& view, const CanvasTarget& target) {
  if (!anyFill_ || !fill_.use()) return;
  table_.bind();
  glBindVertexArray(fillArray_.name());
  forVisibleTiles(fill_, view, target, tiles_, 0, [&](std::size_t t) {
    glDrawElements(GL_TRIANGLES, GLsizei(triangles_[t].count), GL_UNSIGNED_INT,
                   offset(triangles_[t].first * sizeof(std::uint32_t)));
  });
}

void PolygonMesh::renderLines(const CanvasView& view, const CanvasTarget& target, float opacity) {
  if (!(opacity > 0) || !line_.use()) return;
  table_.bind();
  line_.set("uOpacity", opacity);
  glBindVertexArray(lineArray_.name());
  glBindBuffer(GL_ARRAY_BUFFER, edgeData_.name());
  forVisibleTiles(line_, view, target, tiles_, widestLine_, [&](std::size_t t) {
    const std::size_t at = edges_[t].first * sizeof(Edge);  // OpenGL 3.3 has no first instance
    floats(0, 2, sizeof(Edge), at);
    floats(1, 2, sizeof(Edge), at + sizeof(glm::vec2));
    word(2, sizeof(Edge), at + 2 * sizeof(glm::vec2));
    glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, GLsizei(edges_[t].count));
  });
}

void PolygonMesh::render(const CanvasView& view, const CanvasTarget& target, float lineOpacity) {
  if (empty() || table_.empty()) return;
  renderFills(view, target);
  renderLines(view, target, lineOpacity);
  glBindVertexArray(0);
}

void PolygonMesh::draw(ImDrawList& list, const CanvasView& view, float lineOpacity) {
  if (empty()) return;
  ContentHash hash;
  hash.add(shapes_);
  hash.add(table_.content());
  hash.add(lineOpacity);
  addView(hash, view);
  pending_ = {[this, view, lineOpacity](const CanvasTarget& target) { render(view, target, lineOpacity); },
              hash.value()};
  addRender(list, &pending_);
}

const std::string& PolygonMesh::problem() const {
  return fill_.problem().empty() ? line_.problem() : fill_.problem();
}

}  // namespace acentric::ui
