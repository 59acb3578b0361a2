#pragma once
/// Names, stages, reasons and findings that the engine makes. What engineText() translates.

#include <array>

#include "ui/translate.h"

namespace acentric::editor {

inline constexpr std::array kEngineTexts = {
    // labelOf(Effect)
    trLater("Textures"), trLater("Vertex colours"), trLater("Alpha test"), trLater("Alpha blend"),
    trLater("Emission"), trLater("Directional lights"), trLater("Point lights"), trLater("Spot lights"),
    trLater("Glowing surfaces as lights"), trLater("Sky light"), trLater("Hard shadows"),
    trLater("Soft shadows"), trLater("Ambient occlusion"), trLater("Diffuse interreflection"),
    trLater("Mirror reflection"), trLater("Transmission"), trLater("Normal maps"), trLater("Unlit materials"),
    // EffectState::reason where it names nothing
    trLater("no used material has a texture"), trLater("no used material has an alpha mask"),
    trLater("no used material blends by alpha"), trLater("no used material emits light"),
    trLater("no used material is smooth metal"), trLater("no used material lets light through"),
    trLater("no used material has a normal map"), trLater("every used material is lit"),
    trLater("no mesh has vertex colours other than white"), trLater("every used material is unlit"),
    trLater("what glows is too faint or small to light others"), trLater("the scene has a sky"),
    trLater("the scene has no sky"), trLater("the scene has no light"),
    trLater("lights without size cast hard shadows"), trLater("no light without size"),
    trLater("surfaces that glow cast soft shadows"), trLater("lights have no size"),
    trLater("sun and sky reach most surfaces themselves"),
    trLater("lamps alone leave what they do not shine on to bounced light"),
    trLater("bounced light takes its place"), trLater("light from the sky reaches corners less"),
    trLater("stands in for bounced light: the scene has only local lights"), trLater("no light from the sky"),
    trLater("no directional light"), trLater("no point light"), trLater("no spot light"),
    // wordsFor(ErrorSource)
    trLater("holes, filled or not"), trLater("silhouettes"), trLater("border of local polygons"),
    trLater("metals, mirrors, glass"), trLater("local polygons"), trLater("sky, background"),
    trLater("captured surfaces"),
    // describe(Configuration)
    trLater("45° cameras, octagons and squares (4.8.8)"),
    trLater("60° cameras, hexagons and triangles (3.6.3.6)"), trLater("60° cameras, hexagons (6.6.6)"),
    trLater("90° cameras, squares in a checkerboard"),
    trLater("90° cameras, squares (a full panorama at each corner)"),
    trLater("120° cameras, triangles and hexagons (3.6.3.6)"),
    trLater("120° cameras, triangles (a full panorama at each corner)"),
    // MeasureInfo::label
    trLater("depth error"), trLater("holes"), trLater("flicker"), trLater("bake"), trLater("on disk"),
    trLater("load"), trLater("frame"), trLater("frame p99"),
    // nameOf(BakePreset), and differencesFrom
    trLater("draft"), trLater("balanced"), trLater("fine"), trLater("samples per degree"),
    trLater("ambient rays"), trLater("shadow rays"), trLater("bounces"), trLater("colour quality"),
    trLater("surface texel"), trLater("most layers"), trLater("pruning"), trLater("pruning loss"),
    trLater("test eyes"), trLater("distance shift"),
    // nameOf(SourceRole), and sourceName where it names no camera
    trLater("cover"), trLater("other hand"), trLater("panorama"), trLater("hole"), trLater("filled hole"),
    trLater("local geometry"), trLater("background"),
    // Stages of jobs
    trLater("asking the picture"), trLater("asking what needs light"), trLater("checking meshes"),
    trLater("checking the placement"), trLater("checking what is baked"), trLater("comparing holes"),
    trLater("counting triangles per region"), trLater("estimating the exposure"),
    trLater("finding local geometry"), trLater("finding the storeys"), trLater("finding the walkable area"),
    trLater("laying cells on stairs"), trLater("loading captures"), trLater("looking from test eyes"),
    trLater("looking in the cache"), trLater("placing the cells"), trLater("preparing rays"),
    trLater("probing cameras"), trLater("probing light on surfaces"), trLater("reading textures"),
    trLater("reading what is baked"), trLater("simplifying regions above the budget"),
    trLater("taking the scene over"), trLater("tracing the truth"), trLater("writing regions"),
    trLater("writing the page"), trLater("writing captures"), trLater("writing local geometry"),
    trLater("writing OpenEXR files"), trLater("reading the file"), trLater("reading meshes"),
    trLater("tracing pictures"), trLater("bringing the model into the project's folder"),
    trLater("baking surface light"), trLater("baking surface light at the edges of shadows")};

/// The same with values, each of which stands for any text.
inline constexpr std::array kEnginePatterns = {
    // Names of cameras, stages, reasons of placements and of effects
    trLater("camera {}, looks to {}°"),
    trLater("panorama {}, looks to {}°"),
    trLater("free APV {}, looks to {}°"),
    trLater("it is inside a solid: {} of {} directions meet the back of a surface first, and {} cross an odd "
            "number of surfaces"),
    trLater("a surface is {} m away straight above it; {} m are asked for"),
    trLater("a surface is {} m away straight below it; {} m are asked for"),
    trLater("a surface is {} m away towards {} degrees; {} m are asked for"),
    trLater("a surface is {} m away towards {} degrees and up; {} m are asked for"),
    trLater("a surface is {} m away towards {} degrees and down; {} m are asked for"),
    trLater("nothing is below it"),
    trLater("what is below it lies {} m above the walk plane"),
    trLater("the floor below it lies {} m below the walk plane"),
    trLater("none of {} places in it has a floor within {} m of the walk plane, {} m of head room and {} m "
            "to the sides"),
    trLater("{} material with textures: {}"),
    trLater("{} materials with textures: {}"),
    trLater("{} material with an alpha mask: {}"),
    trLater("{} materials with an alpha mask: {}"),
    trLater("{} material with alpha blending: {}"),
    trLater("{} materials with alpha blending: {}"),
    trLater("{} material that emit light: {}"),
    trLater("{} materials that emit light: {}"),
    trLater("{} material that are smooth metal: {}"),
    trLater("{} materials that are smooth metal: {}"),
    trLater("{} material that let light through: {}"),
    trLater("{} materials that let light through: {}"),
    trLater("{} material with normal maps: {}"),
    trLater("{} materials with normal maps: {}"),
    trLater("{} material without lighting: {}"),
    trLater("{} materials without lighting: {}"),
    trLater("{} material bright and large enough to light others: {}"),
    trLater("{} materials bright and large enough to light others: {}"),
    trLater("{} mesh with vertex colours: {}"),
    trLater("{} meshes with vertex colours: {}"),
    trLater("{} directional light: {}"),
    trLater("{} directional lights: {}"),
    trLater("{} point light: {}"),
    trLater("{} point lights: {}"),
    trLater("{} spot light: {}"),
    trLater("{} spot lights: {}"),
    trLater("{} light with a size: {}"),
    trLater("{} lights with a size: {}"),
    trLater("baking camera {} ({} of {})")};

}  // namespace acentric::editor
