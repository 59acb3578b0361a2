#pragma once
/// What stands in errors and before them.

#include <array>

#include "ui/translate.h"

namespace acentric::editor {

/// For a "{}" of an error.
inline constexpr std::array kErrorParts = {
    // What is out of its range
    trLater("the cell size in metres"), trLater("the lattice origin's x in metres"),
    trLater("the lattice origin's y in metres"), trLater("the rotation in radians"),
    trLater("the floor height in metres"), trLater("the eye height in metres"),
    trLater("the near band in metres"), trLater("the x in metres where the slope has the floor's height"),
    trLater("the y in metres where the slope has the floor's height"),
    trLater("the slope's rise in metres per metre"), trLater("the eye height"),
    trLater("the floor tolerance"), trLater("the step height"), trLater("the wall clearance"),
    trLater("the grid step"), trLater("room around a camera"), trLater("floor tolerance"),
    trLater("wall clearance"), trLater("farthest push"),
    // Regions, in lists of a layout
    trLater("added"), trLater("removed"), trLater("split"), trLater("differently sampled"),
    // Kinds of JSON, and what is counted
    trLater("an object"), trLater("a list"), trLater("a text in quotes"), trLater("true or false"),
    trLater("a whole number"), trLater("a number"), trLater("on or off"),
    // Who bakes, and the way out
    trLater("wait until it has ended, or bake in its place with --take-over"),
    trLater("no device on this machine"), trLater("there is no memory"),
    trLater("There is no xdg-open (package xdg-utils) to open a browser"),
    trLater("xdg-open found no browser"), trLater("folder of OpenEXR captures"), trLater("3D Tiles walk"),
    trLater("glTF walk"),
    // What import goes by, and what extensions would add
    trLater("the file's comments"), trLater("the file's unit scale"),
    trLater("the file says that it is a level of Cube 2, which has 8 units to the metre"),
    trLater("the file"), trLater("centimetres"), trLater("millimetres"),
    trLater("surfaces have measured colours only"),
    trLater("export the model without it, or remove it with a tool such as gltf-transform"),
    trLater("convert its pictures to PNG, JPEG or WebP (gltf-transform png, jpeg or webp)"),
    trLater("what it adds"), trLater("all variants but the default one"),
    trLater("the strength and tint of highlights"), trLater("the shine of clear coats"),
    trLater("the sheen of cloth"), trLater("bending by glass"),
    trLater("the colour that thick glass takes on"), trLater("iridescent colours"),
    trLater("brushed highlights"), trLater("colours split by glass"),
    trLater("light that shines through leaves and paper"), trLater("the hiding of nodes: all are shown"),
    trLater("light from its environment picture"), trLater("the shapes of lamps' beams"),
    trLater("textures that are AVIF pictures"), trLater("textures that are DDS pictures"),
    trLater("coarser levels of detail: the finest is taken"), trLater("the compressed geometry"),
    trLater("compress it with EXT_meshopt_compression instead (gltfpack -c)"), trLater("its splats"),
    trLater("export the model as triangles"),
    // What a schema counts
    trLater("entries"), trLater("characters")};

/// For Error::where, or a part of it.
inline constexpr std::array kErrorPlaces = {
    // Error::where that names no file
    trLater("layout"),        trLater("bake settings"), trLater("outline"),
    trLater("storey"),        trLater("storeys"),       trLater("stairs"),
    trLater("walkable area"), trLater("placement"),     trLater("surface coverage"),
    trLater("plan coverage"), trLater("near ground"),   trLater("surface light"),
    trLater("panoramas"),     trLater("view"),          trLater("view settings"),
    trLater("walk"),          trLater("estimate"),      trLater("mesh decimation")};

/// Reasons that the system gives, of strerror().
inline constexpr std::array kSystemTexts = {trLater("No such file or directory"),
                                            trLater("Permission denied"),
                                            trLater("No space left on device"),
                                            trLater("Disk quota exceeded"),
                                            trLater("Read-only file system"),
                                            trLater("Not a directory"),
                                            trLater("Is a directory"),
                                            trLater("File exists"),
                                            trLater("File name too long"),
                                            trLater("Input/output error"),
                                            trLater("Too many open files"),
                                            trLater("Cannot allocate memory"),
                                            trLater("Device or resource busy")};

}  // namespace acentric::editor
