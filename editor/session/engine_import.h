#pragma once
/// Lines of the import report: what import found, guessed, ignored and dropped.

#include <array>

#include "ui/translate.h"

namespace acentric::editor {

/// Each "{}" stands for any text, at the beginning for a number.
inline constexpr std::array kImportPatterns = {
    // Found
    trLater("{} triangles in {} mesh"), trLater("{} triangles in {} meshes"), trLater("{} material"),
    trLater("{} materials"), trLater("{} texture"), trLater("{} textures"), trLater("{} light"),
    trLater("{} lights"), trLater("{} x {} x {} m (x, y, z up)"),
    trLater("materials: two-sided (the format does not say)"), trLater("unit: metres (the file states none)"),
    trLater("up axis: Y (the file states none)"), trLater("no lights: a sun and sky were added"),
    trLater("no lights: only what emits or is unlit can be seen"),
    trLater("no sky: one was added in proportion to the directional light"),
    trLater("normals: {} mesh without any are shaded flat"),
    trLater("normals: {} meshes without any are shaded flat"),
    // With instances
    trLater("{} triangles ({} unique), in {} meshes and {} instances of {} shared meshes"),
    trLater("{} triangles ({} unique), in {} meshes and {} instances of {} shared mesh"),
    // Guessed: engine/scene/finish_scene, default_light, texture_light, readers
    trLater("tangents: made for {} mesh"), trLater("tangents: made for {} meshes"),
    trLater("the scene is {} km across: if that is too large, set metres per unit"),
    trLater("the scene is only {} m across: if that is too small, set metres per unit"),
    trLater("project origin: moved to ({}, {}, {}) m, near the scene"),
    trLater("vertex colours: taken as sRGB (the format does not say)"),
    trLater("light {}: falls off with the square of the distance (the file does not say)"),
    trLater("scene: the only one (the file names no default)"),
    trLater("scene: the first one (the file names no default)"),
    trLater("morph targets: by their default weights"), trLater("skins: in the pose of the file's nodes"),
    trLater("light: computed, as chosen, for {} material that the file declares unlit"),
    trLater("light: computed, as chosen, for {} materials that the file declares unlit"),
    trLater("light: in the textures already (the file declares every material unlit)"),
    // Ignored: readers of glTF and of other formats
    trLater("height (bump) textures"), trLater("opacity texture {} of material {}"),
    trLater("texture {}: it needs a third set of texture coordinates"),
    trLater("a texture of material {}: it needs a third set of texture coordinates"),
    trLater("texture {}: is too large"), trLater("texture {}: has no data"),
    trLater("X as up axis (Y is taken)"), trLater("skins (the meshes stand as modelled)"),
    trLater("textures of mesh {}: it has no texture coordinates"),
    trLater("textures of mesh {}: it has no usable {}"),
    trLater("light {}: neither directional, point nor spot"), trLater("light {}, which does not exist"),
    trLater("light {} of unknown type '{}'"), trLater("light {} with a broken transform"),
    trLater("material {}, which does not exist (the default material is used)"),
    trLater("occlusion textures (occlusion is baked)"), trLater("transmission textures (the factor is used)"),
    trLater("specular colours of KHR_materials_pbrSpecularGlossiness (its diffuse colour is used)"),
    trLater("texture {}, which does not exist"),
    trLater("image {}, which does not exist or has a format that is not played"),
    trLater("a second parent of node {}"), trLater("mesh {} without positions"),
    trLater("instances of {} that are shrunk to nothing or not finite"), trLater("and {} more"),
    trLater("{} other scene"), trLater("{} other scenes"),
    // Dropped
    trLater("{} triangle without area"), trLater("{} triangles without area"),
    trLater("{} triangle with positions that are not finite numbers"),
    trLater("{} triangles with positions that are not finite numbers"),
    trLater("{} triangle with indices out of range"), trLater("{} triangles with indices out of range")};

}  // namespace acentric::editor
