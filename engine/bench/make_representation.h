#pragma once
/// The ways of keeping a scene that bench representations compares.

#include "engine/bench/representation.h"
#include "engine/layout/panorama_set.h"
#include "engine/pipeline/bake_forecast.h"

namespace acentric {

struct SizeTarget {
  std::optional<double> bytes;  ///< none: the project's samples per degree, whatever they take
  double tolerance = 0.1;       ///< share that the bytes may be off
};

/// The project's layout with another configuration over the same outline: rings whose cameras stand as far
/// from their centres.
LayoutSpec relaid(const LayoutSpec& spec, Configuration configuration);

/// What making one will bake; nothing where an earlier run did. If captures are to take a number of bytes, as
/// if a part of them told the resolution at which they do: up to two more tries may follow.
struct RepresentationBake {
  OpenProject open;
  std::vector<int> cameras = {};
  bool light = false;
  std::optional<double> packedBytes = {};  ///< that captures are to take
  std::uint64_t bytesThere = 0;            ///< of what it takes (RepresentationCost::bytes()) without them
  BakeShare share() const;
};

/// Layered captures of a layout with light on what is near: this project's way. `spec`: the project's, or one
/// that was laid anew.
Result<Representation> makeRings(const Workplace& at, const std::string& name, const LayoutSpec& spec,
                                 const SizeTarget& target);
/// Where light is to be baked too, what it will take is not taken off `packedBytes`.
Result<RepresentationBake> bakeOfRings(const Workplace& at, const std::string& name, const LayoutSpec& spec,
                                       const SizeTarget& target);

/// All of the scene's polygons, simplified to so many triangles (or as near as its borders allow), with light
/// baked to them. Where it lacks a surface it shows the sky; that counts as a hole.
Result<Representation> makeMesh(const Workplace& at, const std::string& name, std::size_t mostTriangles);
/// Simplifying apart.
Result<RepresentationBake> bakeOfMesh(const Workplace& at, const std::string& name,
                                      std::size_t mostTriangles);

/// Panoramas of one layer, without polygons, drawn with a depth test. `merged`: of each group's panoramas
/// only what those before it do not show is kept.
Result<Representation> makePanoramas(const Workplace& at, const std::string& name, std::string description,
                                     PanoramaSet panoramas, bool merged, const SizeTarget& target);
/// As if merging left nothing out.
Result<RepresentationBake> bakeOfPanoramas(const Workplace& at, const std::string& name,
                                           const PanoramaSet& panoramas, bool merged,
                                           const SizeTarget& target);

}  // namespace acentric
