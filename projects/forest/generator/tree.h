#pragma once
/// Trees and shrubs: stems that branch level by level, as tubes of bark, and cards of leaves along the last
/// of them. A species says how; the same seed grows the same branches whatever the number of triangles, with
/// more of them modelled, and more and smaller cards, the more there are.

#include <cstddef>
#include <cstdint>
#include <vector>

#include "projects/gallery/generator/model.h"

namespace acentric::forest {

/// How stems of a level grow out of those of the level below; the first level is the trunk's.
struct StemLevel {
  int count = 1;              ///< on each stem below
  float first = 0;            ///< where they begin, as a share of that stem
  float angle = 45;           ///< from that stem, degrees, at its foot,
  float angleAtTip = 45;      ///< and at its tip
  float angleSpread = 8;      ///< degrees, either way
  float length = 0.4f;        ///< share of that stem's; of the trunk: metres
  float lengthSpread = 0.2f;  ///< share of its own, either way
  float radius = 0.5f;        ///< share of that stem's where it grows; of the trunk: metres at the foot
  int segments = 6;
  float bend = 20;    ///< degrees from segment to segment, either way, over the whole stem
  float up = 0;       ///< how strongly it turns upwards over its length; below 0: it hangs
  bool flat = false;  ///< to the left and right alone, as twigs of conifers
};

enum class Crown { round, broad, cone, flame };

struct Leaves {
  float length = 0.3f, width = 0.22f;  ///< of a card with all its triangles, metres
  float angle = 50;                    ///< from the twig, degrees
  float droop = 0.3f;                  ///< of the tip, share of the length
  float from = 0.2f;                   ///< where they begin, as a share of the twig
  float upright = 0;                   ///< 0: they lie around the twig, 1: they face the sky
};

struct Species {
  const char* name = "";
  std::vector<StemLevel> levels;  ///< trunk, branches, ..., twigs
  Crown crown = Crown::round;
  Leaves leaves;
  float flare = 0.5f;         ///< of the trunk's foot, share of its radius
  std::size_t triangles = 0;  ///< with all of its detail
};

/// Its foot is the origin. About so many triangles (a card more or less, at least 40).
gallery::Thing makeTree(const Species& species, std::size_t triangles, std::uint64_t seed, int bark,
                        int leaf);

// Those of the town.
Species oak();
Species lime();
Species birch();
Species spruce();
Species pine();
Species apple();
Species hazel();  ///< a shrub

}  // namespace acentric::forest
