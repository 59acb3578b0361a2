#include "engine/bench/repeated_walk.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <mutex>
#include <set>

#include "engine/base/contract.h"
#include "engine/base/json_text.h"
#include "engine/export/local_file.h"
#include "engine/export/region_order.h"
#include "engine/export/walk_format.h"
#include "engine/store/keyed.h"
#include "engine/store/packed_text.h"

namespace acentric {
namespace {

using Json = BundleJson;

/// Cells around a leaf's own: what is within two steps of neighbours, and what panoramas of these are made
/// of.
constexpr int kMargin = 3;
/// It is packed each time it is read.
constexpr int kTextLevel = 3;
/// Near geometry packs a little better or worse by where it lies.
constexpr double kLocalRoom = 1.5;

LocalGeometry moved(LocalGeometry local, const glm::dvec2& by) {
  const auto move = [&](glm::vec3& p) { p = glm::vec3(glm::dvec3(p) + glm::dvec3(by, 0)); };
  for (LocalVertex& vertex : local.vertices) move(vertex.position);
  auto surfaces = std::make_shared<LocalSurfaces>(*local.surfaces);
  for (Mesh& mesh : surfaces->meshes) std::ranges::for_each(mesh.positions, move);
  local.surfaces = std::move(surfaces);
  return local;
}

}  // namespace

RepeatedWalk::RepeatedWalk(std::shared_ptr<const RepeatedCell> cell, const RepeatedWalkOptions& options)
    : cell_(std::move(cell)) {
  // About a square.
  const double slots = cell_->lattice().slots();
  const double across = glm::length(cell_->step(1, 0)), up = glm::length(cell_->step(0, 1));
  const double needed = std::ceil(double(options.regions) / slots);
  cells_.x = std::max(1, int(std::lround(std::sqrt(needed * up / across))));
  cells_.y = std::max(1, int(std::ceil(needed / cells_.x)));
  const double most = std::max(1.0, std::floor(options.regionsPerPage / slots));
  block_.x = std::max(1, int(std::sqrt(most)));
  block_.y = std::max(1, int(most / block_.x));
  blocks_ = (cells_ + block_ - 1) / block_;
}

std::uint64_t RepeatedWalk::regions() const {
  return std::uint64_t(cells_.x) * std::uint64_t(cells_.y) * std::uint64_t(cell_->lattice().slots());
}

std::uint64_t RepeatedWalk::numberOf(const CellId& region) const {
  return (std::uint64_t(region.j) * std::uint64_t(cells_.x) + std::uint64_t(region.i)) *
             std::uint64_t(cell_->lattice().slots()) +
         std::uint64_t(region.slot);
}

CellId RepeatedWalk::regionOf(std::uint64_t number) const {
  const auto slots = std::uint64_t(cell_->lattice().slots()), across = std::uint64_t(cells_.x);
  return {int(number / slots % across), int(number / slots / across), int(number % slots)};
}

/// A camera is there if some region draws it: in each row of cells those of a kind are next to each other.
void RepeatedWalk::numberCameras() {
  int lowRow = 0, highRow = cells_.y - 1;
  for (const auto& kind : cell_->cameras_)
    for (const glm::ivec2& from : kind.from)
      lowRow = std::min(lowRow, -from.y), highRow = std::max(highRow, cells_.y - 1 - from.y);
  lowRow_ = lowRow;
  for (int j = lowRow; j <= highRow; ++j)
    for (const auto& kind : cell_->cameras_) {
      int low = 0, end = 0;
      bool any = false;
      for (const glm::ivec2& from : kind.from) {
        if (j + from.y < 0 || j + from.y >= cells_.y) continue;
        low = any ? std::min(low, -from.x) : -from.x;
        end = any ? std::max(end, cells_.x - from.x) : cells_.x - from.x;
        any = true;
      }
      rows_.push_back({cameraCount_, low});
      cameraCount_ += std::uint64_t(end - low);
    }
}

std::uint64_t RepeatedWalk::numberOf(const CameraId& camera) const {
  const Row& row = rows_[std::size_t(camera.j - lowRow_) * cell_->cameras_.size() + cell_->kindOf(camera)];
  return row.first + std::uint64_t(camera.i - row.low);
}

CameraId RepeatedWalk::cameraOf(std::uint64_t number) const {
  const auto after = std::ranges::upper_bound(rows_, number, {}, &Row::first);
  const auto row = std::size_t(after - rows_.begin()) - 1;
  const auto& kind = cell_->cameras_[row % cell_->cameras_.size()];
  return {rows_[row].low + int(number - rows_[row].first), lowRow_ + int(row / cell_->cameras_.size()),
          kind.corner, kind.direction, 0};
}

/// Data are the near geometry of all regions, then the coarse captures of all cameras, then the full ones,
/// each of the same length.
std::uint64_t RepeatedWalk::placeOf(std::uint64_t camera, bool full) const {
  const std::uint64_t coarse = regions() * localStride_;
  return full ? coarse + cameraCount_ * coarseStride_ + camera * fullStride_
              : coarse + camera * coarseStride_;
}

std::vector<std::byte> RepeatedWalk::packOf(const CameraId& camera, bool full) const {
  const auto& kind = cell_->cameras_[cell_->kindOf(camera)];
  std::vector<std::byte> pack = full ? kind.full : kind.coarse;
  movePack(pack, cell_->lattice().cornerPosition(camera.i, camera.j, camera.corner, 0));
  return pack;
}

Result<std::vector<std::byte>> RepeatedWalk::localOf(const CellId& region) const {
  auto bytes =
      localFileBytes(moved(*cell_->locals_[std::size_t(region.slot)], cell_->step(region.i, region.j)));
  if (bytes && bytes->size() > localStride_)
    return fail(ErrorKind::internal, "near geometry takes more room when it is moved", "repeated walk");
  return bytes;
}

Result<RepeatedWalk::LocalFacts> RepeatedWalk::factsOf(const CellId& region) const {
  if (!facts_.empty()) return facts_[numberOf(region)];
  const auto bytes = localOf(region);
  if (!bytes) return tl::unexpected(bytes.error());
  return LocalFacts{Hasher().bytes(bytes->data(), bytes->size()).finish(), std::uint32_t(bytes->size())};
}

/// How long the parts of the data are.
void RepeatedWalk::layOut() {
  for (const auto& kind : cell_->cameras_) {
    fullStride_ = std::max<std::uint64_t>(fullStride_, kind.full.size());
    coarseStride_ = std::max<std::uint64_t>(coarseStride_, kind.coarse.size());
  }
  localStride_ = ~std::uint64_t(0);
  std::uint64_t longest = 1;
  for (int slot = 0; slot < cell_->lattice().slots(); ++slot)
    if (cell_->locals_[std::size_t(slot)])
      if (const auto bytes = localOf({0, 0, slot})) longest = std::max<std::uint64_t>(longest, bytes->size());
  localStride_ = std::uint64_t(kLocalRoom * double(longest)) + 256;
}

Result<std::string> RepeatedWalk::leafText(std::size_t number, WalkBox& box) const {
  const glm::ivec2 low = glm::ivec2(int(number) % blocks_.x, int(number) / blocks_.x) * block_;
  const glm::ivec2 high = glm::min(low + block_, cells_);
  LayoutSpec spec = cell_->spec();
  const glm::ivec2 from = glm::max(low - kMargin, glm::ivec2(0)), to = glm::min(high + kMargin, cells_);
  for (int j = from.y; j < to.y; ++j)
    for (int i = from.x; i < to.x; ++i)
      for (int slot = 0; slot < cell_->lattice().slots(); ++slot) spec.added.insert({i, j, slot});
  auto layout = buildLayout(spec);
  if (!layout) return tl::unexpected(layout.error());
  const auto neighbours = touching(layout->regions);

  const auto isOwn = [&](const CellId& id) {
    return id.i >= low.x && id.j >= low.y && id.i < high.x && id.j < high.y;
  };
  std::set<int> own;
  for (std::size_t r = 0; r < layout->regions.size(); ++r)
    if (isOwn(layout->regions[r].id)) own.insert(int(r));
  std::map<std::uint64_t, int> inPage;  // by number in the storey
  for (const int region : withBeyond(neighbours, own))
    inPage.emplace(numberOf(layout->regions[std::size_t(region)].id), region);

  WalkLeaf leaf;
  std::vector<int> placeIn(layout->regions.size(), -1);
  for (const auto& [_, region] : inPage) {
    placeIn[std::size_t(region)] = int(leaf.regions.size());
    leaf.regions.push_back(numberOf(layout->regions[std::size_t(region)].id));
  }
  std::map<int, int> cameraPlace;
  const auto fileOf = [](const char* folder, std::uint64_t file, std::span<const std::byte> bytes) {
    return BundleFile{fmt::format("{}/{}", folder, file), bytes.size(),
                      Hasher().bytes(bytes.data(), bytes.size()).finish()};
  };
  const auto renumbered = [&](std::vector<Cover> covers) {
    for (Cover& cover : covers)
      for (Piece& piece : cover.pieces) {
        const auto [found, isNew] = cameraPlace.emplace(piece.camera, int(cameraPlace.size()));
        if (isNew) {
          const LayoutCamera& camera = layout->cameras[std::size_t(piece.camera)];
          const std::uint64_t its = numberOf(camera.id);
          BundleCamera renditions = cell_->cameras_[cell_->kindOf(camera.id)].renditions;
          renditions.full->file = fileOf("full", its, packOf(camera.id, true));
          renditions.coarse->file = fileOf("coarse", its, packOf(camera.id, false));
          leaf.part.layout.cameras.push_back(camera);
          leaf.part.cameras.push_back(std::move(renditions));
          leaf.cameras.push_back(its);
        }
        piece.camera = found->second;
      }
    return covers;
  };
  for (const auto& [its, r] : inPage) {
    const auto region = std::size_t(r);
    const CellId& id = layout->regions[region].id;
    leaf.own.push_back(isOwn(id) ? 1 : 0);
    if (isOwn(id))
      for (const glm::dvec2& corner : layout->regions[region].polygon.corners) box.add(corner);
    std::vector<Cover> panoramas = layout->panoramasFor(r);
    leaf.part.layout.regions.push_back(layout->regions[region]);
    std::vector<Cover>& covers = leaf.part.layout.regions.back().covers;
    covers = renumbered(std::move(covers));
    leaf.part.layout.panoramas.push_back(renumbered(std::move(panoramas)));
    leaf.part.local.emplace_back();
    if (const auto& local = cell_->locals_[std::size_t(id.slot)]) {
      const auto facts = factsOf(id);
      if (!facts) return tl::unexpected(facts.error());
      leaf.part.local.back() =
          BundleLocal{{fmt::format("near/{}", its), facts->bytes, facts->hash}, local->triangles.size()};
    }
    leaf.part.neighbours.emplace_back();
    for (const int n : neighbours[region])
      if (placeIn[std::size_t(n)] >= 0) leaf.part.neighbours.back().push_back(placeIn[std::size_t(n)]);
    std::ranges::sort(leaf.part.neighbours.back());
  }
  return jsonText(leafPage(leaf, [&](const BundleFile& file) {
    const std::size_t slash = file.path.find('/');
    const std::uint64_t its = std::stoull(file.path.substr(slash + 1));
    if (file.path.starts_with("near")) return its * localStride_;
    return placeOf(its, file.path.starts_with("full"));
  }));
}

Result<std::vector<std::byte>> RepeatedWalk::leafBytes(std::size_t leaf) const {
  WalkBox box;
  const auto text = leafText(leaf, box);
  if (!text) return tl::unexpected(text.error());
  return packedText(*text, kTextLevel);
}

Status RepeatedWalk::makePages(TaskRunner& runner, const Progress& progress, const std::stop_token& stop) {
  std::mutex mutex;
  std::optional<Error> failed;
  const auto forAll = [&](std::size_t count, const char* stage, const auto& body) -> Status {
    std::size_t done = 0;
    runner.parallelFor(count, [&](std::size_t n) {
      {
        const std::lock_guard lock(mutex);
        if (failed || stop.stop_requested()) return;
      }
      const Status made = body(n);
      const std::lock_guard lock(mutex);
      if (!made) failed = made.error();
      if (progress) progress({double(++done), double(count), stage});
    });
    if (failed) return tl::unexpected(*failed);
    if (stop.stop_requested())
      return fail(ErrorKind::cancelled, "making the index was stopped", "repeated walk");
    return {};
  };
  std::vector<LocalFacts> facts(regions());
  constexpr std::size_t kTogether = 256;
  Status made =
      forAll((facts.size() + kTogether - 1) / kTogether, "near geometry", [&](std::size_t n) -> Status {
        for (std::size_t r = n * kTogether; r < std::min(facts.size(), (n + 1) * kTogether); ++r) {
          const CellId region = regionOf(r);
          if (!cell_->locals_[std::size_t(region.slot)]) continue;
          const auto its = factsOf(region);
          if (!its) return tl::unexpected(its.error());
          facts[r] = *its;
        }
        return {};
      });
  if (!made) return made;
  facts_ = std::move(facts);
  leaves_.resize(std::size_t(blocks_.x) * std::size_t(blocks_.y));
  made = forAll(leaves_.size(), "making the index", [&](std::size_t n) -> Status {
    Page page;
    const auto text = leafText(n, page.box);
    if (!text) return tl::unexpected(text.error());
    const std::vector<std::byte> bytes = packedText(*text, kTextLevel);
    page.bytes = std::uint32_t(bytes.size()), page.raw = std::uint32_t(text->size());
    page.hash = Hasher().bytes(bytes.data(), bytes.size()).finish();
    leaves_[n] = page;
    return {};
  });
  if (!made) return made;
  std::vector<LocalFacts>().swap(facts_);

  struct Node {
    Json entry;
    WalkBox box;
  };
  std::uint64_t at = 0;
  std::vector<Node> level;
  glm::ivec2 size = blocks_;
  for (Page& leaf : leaves_) {
    leaf.at = at, at += leaf.bytes;
    level.push_back({pageEntry(leaf.at, leaf.bytes, leaf.hash.toHex(), leaf.raw, leaf.box, true), leaf.box});
  }
  while (level.size() > 1) {  // so many pages side by side have one above them
    constexpr glm::ivec2 kChildren{8, int(kMostWalkChildren) / 8};
    const glm::ivec2 fewer = (size + kChildren - 1) / kChildren;
    std::vector<Node> above;
    for (int y = 0; y < fewer.y; ++y)
      for (int x = 0; x < fewer.x; ++x) {
        std::vector<Json> children;
        WalkBox box;
        for (int j = y * kChildren.y; j < std::min(size.y, (y + 1) * kChildren.y); ++j)
          for (int i = x * kChildren.x; i < std::min(size.x, (x + 1) * kChildren.x); ++i) {
            Node& child = level[std::size_t(j) * std::size_t(size.x) + std::size_t(i)];
            box.add(child.box);
            children.push_back(std::move(child.entry));
          }
        const std::string text = jsonText(innerPage(std::move(children)));
        inner_.push_back(packedText(text, kTextLevel));
        innerAt_.push_back(at);
        const std::vector<std::byte>& bytes = inner_.back();
        above.push_back(
            {pageEntry(at, bytes.size(), walk_format::hashText(bytes), text.size(), box, false), box});
        at += bytes.size();
      }
    level = std::move(above), size = fewer;
  }

  Bundle bundle = cell_->root_;
  BundleStorey& storey = bundle.storeys.front();
  const glm::dvec2 middle = cell_->lattice().cornerPosition(cells_.x / 2, cells_.y / 2, 0, 0);
  storey.start = middle;
  for (const int axis : {0, 1})
    bundle.bounds.min[axis] = float(level.front().box.low[axis]),
    bundle.bounds.max[axis] = float(level.front().box.high[axis]);
  auto root = parseJson<Json>(formatBundle(bundle));
  if (!root) return tl::unexpected(root.error());
  WalkStoreyCounts counts{cameraCount_, regions(), -HUGE_VAL, HUGE_VAL};
  for (const auto& kind : cell_->cameras_) {
    counts.topElevation = std::max(counts.topElevation, kind.renditions.topElevation);
    counts.bottomElevation = std::min(counts.bottomElevation, kind.renditions.bottomElevation);
  }
  putPage((*root)["storeys"][0], counts, std::move(level.front().entry));
  const std::string text = jsonText(*root);
  const std::vector<std::byte> packed = packedText(text);
  walk_format::Header header;
  header.rootBytes = packed.size(), header.rootRaw = text.size();
  header.pageStart = pageStart_ = walk_format::kHeaderBytes + packed.size();
  header.dataStart = dataStart_ = pageStart_ + at;
  header.fileBytes = fileBytes_ =
      dataStart_ + regions() * localStride_ + cameraCount_ * (coarseStride_ + fullStride_);
  const ContentKey hash = Hasher().bytes(packed.data(), packed.size()).finish();
  header.rootHash = {hash.high, hash.low};
  const auto bytes = walk_format::headerBytes(header);
  head_.assign(bytes.begin(), bytes.end());
  head_.insert(head_.end(), packed.begin(), packed.end());
  return {};
}

Result<std::shared_ptr<const RepeatedWalk>> RepeatedWalk::make(std::shared_ptr<const RepeatedCell> cell,
                                                               const RepeatedWalkOptions& options,
                                                               TaskRunner& runner, const Progress& progress,
                                                               const std::stop_token& stop) {
  std::shared_ptr<RepeatedWalk> walk(new RepeatedWalk(std::move(cell), options));
  walk->numberCameras();
  walk->layOut();
  if (Status made = walk->makePages(runner, progress, stop); !made) return tl::unexpected(made.error());
  return walk;
}

/// A read is of parts that follow each other: the head, pages, files with what is between them.
Status RepeatedWalk::read(std::uint64_t at, std::span<std::byte> into) const {
  if (at > fileBytes_ || into.size() > fileBytes_ - at)
    return fail(ErrorKind::unreadable, "beyond the end", "repeated walk");
  const auto copy = [&](std::span<const std::byte> part, std::uint64_t begin, std::uint64_t end) {
    const std::uint64_t skipped = at - begin;
    const auto count = std::size_t(std::min<std::uint64_t>(into.size(), end - at));
    const auto there =
        std::size_t(skipped < part.size() ? std::min<std::uint64_t>(count, part.size() - skipped) : 0);
    if (there > 0) std::memcpy(into.data(), part.data() + skipped, there);
    std::memset(into.data() + there, 0, count - there);
    at += count, into = into.subspan(count);
  };
  while (!into.empty()) {
    if (at < pageStart_) {
      copy(head_, 0, pageStart_);
    } else if (at < dataStart_) {
      const std::uint64_t within = at - pageStart_;
      if (const Page& last = leaves_.back(); within < last.at + last.bytes) {
        const auto after = std::ranges::upper_bound(leaves_, within, {}, &Page::at);
        const auto leaf = std::size_t(after - leaves_.begin()) - 1;
        const auto bytes = leafBytes(leaf);
        if (!bytes) return tl::unexpected(bytes.error());
        const std::uint64_t begin = pageStart_ + leaves_[leaf].at;
        copy(*bytes, begin, begin + leaves_[leaf].bytes);
      } else {
        const auto after = std::ranges::upper_bound(innerAt_, within);
        const auto page = std::size_t(after - innerAt_.begin()) - 1;
        const std::uint64_t begin = pageStart_ + innerAt_[page];
        copy(inner_[page], begin, begin + inner_[page].size());
      }
    } else {
      const std::uint64_t within = at - dataStart_, coarse = placeOf(0, false), full = placeOf(0, true);
      if (within < coarse) {
        const std::uint64_t number = within / localStride_;
        const CellId region = regionOf(number);
        std::vector<std::byte> bytes;
        if (cell_->locals_[std::size_t(region.slot)]) {
          auto made = localOf(region);
          if (!made) return tl::unexpected(made.error());
          bytes = std::move(*made);
        }
        const std::uint64_t begin = dataStart_ + number * localStride_;
        copy(bytes, begin, begin + localStride_);
      } else {
        const bool isFull = within >= full;
        const std::uint64_t stride = isFull ? fullStride_ : coarseStride_, start = isFull ? full : coarse;
        const std::uint64_t number = (within - start) / stride, begin = dataStart_ + start + number * stride;
        copy(packOf(cameraOf(number), isFull), begin, begin + stride);
      }
    }
  }
  return {};
}

}  // namespace acentric
