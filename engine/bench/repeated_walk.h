#pragma once
/// A walk over any number of regions whose files are made as they are read: one cell of a lattice is baked,
/// and all others see the same. What reads walks by ranges can be tried, and timed, on layouts that nobody
/// bakes.
///
/// Index and files are those that FORMAT.md describes ("Walks"), at their places, with their hashes; nothing
/// of them is kept but the baked cell and what names the pages of the index.

#include <filesystem>
#include <memory>
#include <optional>
#include <stop_token>
#include <vector>

#include "engine/base/progress.h"
#include "engine/base/task_runner.h"
#include "engine/export/walk_page_write.h"
#include "engine/export/walk_read.h"
#include "engine/layout/lattice.h"

namespace acentric {

struct RepeatedCellOptions {
  Configuration configuration = Configuration::b;
  double cellSize = 2;  ///< metres
  double samplesPerDegree = 4;
};

/// A cell of a lattice with the captures of its cameras and what is near its regions: ground, a pillar in the
/// middle of each ring and low blocks in the gaps between, without light, as far as the eye sees the same.
class RepeatedCell {
 public:
  /// Bakes it in `folder`, which must be empty; nothing of that is needed afterwards.
  static Result<std::shared_ptr<const RepeatedCell>> make(const RepeatedCellOptions& options,
                                                          const std::filesystem::path& folder,
                                                          TaskRunner& runner, const Progress& progress = {},
                                                          const std::stop_token& stop = {});

  const LayoutSpec& spec() const { return spec_; }
  const Lattice& lattice() const { return lattice_; }
  /// From a cell to the next ones, plan, metres.
  glm::dvec2 step(int i, int j) const;

 private:
  friend class RepeatedWalk;
  friend class RepeatedCellMaker;
  /// Of a camera, wherever it stands.
  struct CameraKind {
    int corner = 0, direction = 0;
    BundleCamera renditions;
    std::vector<std::byte> full, coarse;
    /// Cells of regions that draw it, from its own.
    std::vector<glm::ivec2> from;
  };
  explicit RepeatedCell(const LayoutSpec& spec) : spec_(spec), lattice_(*Lattice::of(spec)) {}
  std::size_t kindOf(const CameraId& camera) const;

  LayoutSpec spec_;
  Lattice lattice_;
  Bundle root_;                                       ///< of one storey, without cameras and regions
  std::vector<CameraKind> cameras_;                   ///< sorted by corner and direction
  std::vector<std::optional<LocalGeometry>> locals_;  ///< by slot; none where nothing is near
};

struct RepeatedWalkOptions {
  std::uint64_t regions = 1000;  ///< at least so many: whole cells in about a square
  int regionsPerPage = 64;       ///< of the index, at most
};

/// Any thread.
class RepeatedWalk final : public ByteRanges {
 public:
  /// Makes each page of the index once, for the hashes in those above: the more regions, the longer it takes.
  static Result<std::shared_ptr<const RepeatedWalk>> make(std::shared_ptr<const RepeatedCell> cell,
                                                          const RepeatedWalkOptions& options,
                                                          TaskRunner& runner, const Progress& progress = {},
                                                          const std::stop_token& stop = {});

  Result<std::uint64_t> size() const override { return fileBytes_; }
  Status read(std::uint64_t at, std::span<std::byte> into) const override;

  std::uint64_t regions() const;
  std::uint64_t cameras() const { return cameraCount_; }
  std::size_t pages() const { return leaves_.size() + inner_.size(); }
  std::uint64_t indexBytes() const { return dataStart_; }
  /// Cells along the lattice's two directions.
  glm::ivec2 cells() const { return cells_; }

 private:
  struct Page {
    std::uint64_t at = 0;  ///< from where pages begin
    std::uint32_t bytes = 0, raw = 0;
    ContentKey hash;
    WalkBox box;
  };
  /// Cameras of one kind in one row of cells are numbered one after another.
  struct Row {
    std::uint64_t first = 0;
    int low = 0;
  };

  RepeatedWalk(std::shared_ptr<const RepeatedCell> cell, const RepeatedWalkOptions& options);
  void layOut();
  void numberCameras();
  Status makePages(TaskRunner& runner, const Progress& progress, const std::stop_token& stop);
  /// Of the near geometry of a region.
  struct LocalFacts {
    ContentKey hash;
    std::uint32_t bytes = 0;
  };
  Result<LocalFacts> factsOf(const CellId& region) const;
  Result<std::string> leafText(std::size_t leaf, WalkBox& box) const;
  Result<std::vector<std::byte>> leafBytes(std::size_t leaf) const;

  std::uint64_t numberOf(const CellId& region) const;
  std::uint64_t numberOf(const CameraId& camera) const;
  CellId regionOf(std::uint64_t number) const;
  CameraId cameraOf(std::uint64_t number) const;
  std::uint64_t placeOf(std::uint64_t camera, bool full) const;

  std::vector<std::byte> packOf(const CameraId& camera, bool full) const;
  Result<std::vector<std::byte>> localOf(const CellId& region) const;

  std::shared_ptr<const RepeatedCell> cell_;
  glm::ivec2 cells_{1};
  glm::ivec2 block_{1};    ///< cells of a leaf
  glm::ivec2 blocks_{1};   ///< leaves
  int lowRow_ = 0;         ///< of cameras
  std::vector<Row> rows_;  ///< by row and kind
  std::uint64_t cameraCount_ = 0;
  std::uint64_t fullStride_ = 0, coarseStride_ = 0, localStride_ = 0;  ///< bytes of the data for each

  std::vector<LocalFacts> facts_;  ///< by region, while the index is made: each is in several pages
  std::vector<std::byte> head_;    ///< header and root
  std::vector<Page> leaves_;
  std::vector<std::vector<std::byte>> inner_;  ///< packed, behind the leaves
  std::vector<std::uint64_t> innerAt_;
  std::uint64_t pageStart_ = 0, dataStart_ = 0, fileBytes_ = 0;
};

}  // namespace acentric
