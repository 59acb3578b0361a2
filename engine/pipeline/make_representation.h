#pragma once
/// The ways of keeping a scene that bench representations compares.

#include "engine/layout/panorama_set.h"
#include "engine/pipeline/representation.h"

namespace acentric {

struct SizeTarget {
  std::optional<double> bytes;  ///< none: the project's samples per degree, whatever they take
  double tolerance = 0.1;       ///< share that the bytes may be off
};

/// The project's layout with another configuration over the same outline: rings whose cameras stand as far
/// from their centres.
LayoutSpec relaid(const LayoutSpec& spec, Configuration configuration);

/// Layered captures of a layout with light on what is near: this project's way. `spec`: the project's, or one
/// that was laid anew.
Result<Representation> makeRings(const Workplace& at, const std::string& name, const LayoutSpec& spec,
                                 const SizeTarget& target);

/// All of the scene's polygons, simplified to so many triangles (or as near as its borders allow), with light
/// baked to them. Where it lacks a surface it shows the sky; that counts as a hole.
Result<Representation> makeMesh(const Workplace& at, const std::string& name, std::size_t mostTriangles);

/// Panoramas of one layer, without polygons, drawn with a depth test. `merged`: of each group's panoramas
/// only what those before it do not show is kept.
Result<Representation> makePanoramas(const Workplace& at, const std::string& name, std::string description,
                                     PanoramaSet panoramas, bool merged, const SizeTarget& target);

}  // namespace acentric
