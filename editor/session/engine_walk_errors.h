#pragma once
/// Errors of models, of what is baked and of walks.

#include <array>

#include "ui/translate.h"

namespace acentric::editor {

/// Each "{}" stands for any text, also for another error or a part of one.
inline constexpr std::array kWalkErrors = {
    // Import reports that tell an error or a reason
    trLater("texture {}: {}"), trLater("file {}: {}"), trLater("extension {}: {}"),
    trLater("unit: metres ({})"), trLater("unit: {} m ({})"),
    trLater("unit: {} (the file states none, and as metres the scene would be {} m across)"),
    trLater("up axis: Y ({})"), trLater("up axis: Z ({})"),
    trLater("up axis: Z (the file states none; {} times as much of its surfaces is level with Z up as with Y "
            "up)"),
    trLater("light: in the textures already ({}); it is not computed once more"),
    trLater("{}, triangles are of about one size, there is no lamp: as in a scan"),
    trLater("surfaces have only one picture, each part used once"),
    trLater("surfaces have only {} pictures, each part used once"),
    // Models: engine/scene
    trLater("does not exist"), trLater("is a folder; name the model file in it"), trLater("is empty"),
    trLater("is not a file name"), trLater("vanished during the import"),
    trLater("lies outside the model's folder ({}) and is not read; bring it there, or allow it with "
            "--outside-files"),
    trLater("imports cannot be kept here: {}; set XDG_CACHE_HOME to a folder that can be written"),
    trLater("the importer handed over a broken scene: {}"), trLater("the scene does not fit in memory"),
    trLater("the imported scene cannot be copied: {}"),
    trLater("metres per unit is {}; it must be between 1e-9 and 1e6, or 0 to guess it"),
    trLater("needs more memory than the limit of {} MiB; the file is damaged, or raise the limit with "
            "--import-memory"),
    trLater("needs more memory than there is"),
    trLater("the importer crashed (signal {}) while reading it: the file is probably damaged"),
    trLater("the importer gave up (exit code {}) while reading it: the file is probably damaged"),
    trLater("the importer program is missing or cannot be run; install it beside this program"),
    trLater("the import was cancelled"),
    trLater("reading it took longer than the limit of {} s: give it more time with --import-seconds, or "
            "simplify or split the model"),
    trLater("has {}, those of instances counted once, which take about {} GB of memory; {} GB may be taken: "
            "raise that with --import-memory if there is more, show what is repeated as instances, simplify "
            "the model or split it"),
    trLater("states an absurd size"), trLater("cannot be read"), trLater("cannot be read: {}"),
    trLater("has the extension '{}', which is not a model format that is read"), trLater("has no root node"),
    trLater("names a mesh that does not exist"), trLater("has no surfaces"), trLater("has no surfaces ({})"),
    trLater("has more than {} instances; make one mesh of those that stand together"),
    trLater("has more than 2^31 indices; split it"),
    trLater("requires the extension {}, which is not supported; without it, {} would be lost: {}"),
    trLater("is cut off inside the GLB header"), trLater("is cut off inside the GLB's JSON chunk"),
    trLater("is GLB version {}; only version 2 is played"),
    trLater("is not a glTF file: its JSON is not an object"),
    trLater("is not a glTF 2.0 file: asset.version is missing"),
    trLater("needs glTF {}; version 2.0 is played"), trLater("is glTF {}; version 2.0 is played"),
    trLater("is not a sound glTF file"), trLater("has no scene; export it with one"),
    trLater("its default scene {} does not exist"), trLater("node {} does not exist"),
    trLater("node {} is its own ancestor"), trLater("mesh {} does not exist"),
    trLater("accessor {} does not exist"), trLater("buffer view {} does not exist"),
    trLater("buffer view {} names buffer {}, which does not exist"),
    trLater("buffer view {} reaches past the end of buffer {} ({} bytes)"),
    trLater("{} reaches past the end of buffer view {} ({} bytes)"),
    trLater("is damaged: a PNG checksum differs"), trLater("is cut off: the PNG's end is missing"),
    trLater("is damaged: its checksum is wrong"), trLater("there is not enough memory to write the scene"),
    trLater("simplifying was cancelled"),
    trLater("there is not enough memory to simplify the region's geometry"),
    // What is baked: engine/store, engine/pipeline/check_store
    trLater("is no packed file of this program, or its beginning is damaged"),
    trLater("has {} bytes instead of {}: it was cut or appended to"),
    trLater("is damaged: its checksum differs"), trLater("holds another kind of data than its name says"),
    trLater("has format version {}, this program reads {}; bake it anew"),
    trLater("its description makes no sense"), trLater("its number of samples contradicts its size"),
    trLater("its number of triangles contradicts its size"),
    trLater("was made for key {}, not for the one in its name"), trLater("is not baked"),
    trLater("is damaged and was set aside as *.damaged; bake again ({})"),
    trLater("was damaged and is set aside"), trLater("cannot be used as the folder of captures: {}"),
    trLater("reading was stopped"), trLater("is damaged, or no record of a capture"),
    trLater("is damaged: it has another size than when it was written"),
    trLater("is damaged: its content is not what was written"), trLater("OpenEXR refused to write: {}"),
    trLater("checking was cancelled"),
    // Walks: engine/pipeline/load_walk, walk_*, engine/view
    trLater("not enough memory for a capture: give the walk a lower limit of memory"),
    trLater("loading was cancelled"), trLater("a region above the budget was not simplified: {}"),
    trLater("the local geometry of {} regions is simplified: {} triangles became {}, the surfaces lie at "
            "most {} mm apart"),
    trLater("the eye ({}, {}) stands outside every region; the nearest point inside is ({}, {})"),
    trLater("the eye stands outside every region"),
    trLater("the layout has no region to stand in: place a cell first"),
    trLater("not enough memory for a picture of this size: ask for a smaller one"),
    trLater("the OpenGL renderer needs a window or a headless context: use GlRenderer"),
    trLater("eye, yaw, pitch and field of view must be finite numbers"),
    trLater("pitch must lie in -90..90 degrees"), trLater("field of view {} degrees: must lie in 0.1..179.9"),
    trLater("size {}x{}: each side must lie in 1..16384 pixels"),
    trLater("OpenGL {}.{} is too old, at least 4.3 is needed: use a CPU renderer"),
    trLater("OpenGL draws patches, not {}: use a CPU renderer"),
    trLater("it has no planes of surfaces, and OpenGL draws patches alone: bake it with silhouettes, or use "
            "a CPU renderer"),
    trLater("{}x{} pixels: this driver draws at most {} on a side"),
    trLater("not enough memory to hand this view to OpenGL: use smaller captures"),
    trLater("the comparison was stopped"),
    trLater("{}; {} of them are still above the budget, because the error allows no more"),
    // Walk files: engine/export, engine/pipeline/shipped_walk
    trLater("{}; copy the walk again, or export it anew"), trLater("{}. It is white"),
    trLater("{}. The coarse capture stands in"), trLater("{}. Near geometry is missing there"),
    trLater("{}. Its storey is left out"),
    trLater("is neither a walk (*.acentric) nor the folder of a bundle (with bundle.json); `acentric export` "
            "writes both"),
    trLater("was not baked"), trLater("is in no page of its index"), trLater("is no walk"),
    trLater("has version {}, and this program reads {}: export the walk anew"),
    trLater("is {}, and this program reads {}: export the walk anew"), trLater("is no Acentric bundle"),
    trLater("its header is damaged"), trLater("its header makes no sense"),
    trLater("is damaged: its contents do not fit its hash"), trLater("does not unpack to what the walk says"),
    trLater("has {} bytes and says {}: it is cut off, or not copied whole"),
    trLater("has {} bytes, and the index says {}"),
    trLater("is damaged, or of another bundle: its hash differs"), trLater("its index makes no sense: {}"),
    trLater("not enough memory for its index"), trLater("is not in the walk"),
    trLater("has no region to stand in"), trLater("must be an object"), trLater("lacks '{}'"),
    trLater("must be a list"), trLater("must be a number"), trLater("must be a whole number"),
    trLater("must be a text"), trLater("must be true or false"),
    trLater("must have {} to {} entries, not {}"), trLater("must lie in {} .. {}"),
    // Publishing and export: engine/pipeline/publish_walk, export_*, engine/export, engine/serve
    trLater("is no folder: name a new one for the published walk"),
    trLater("holds {}, which is no part of a published walk and would be lost: name a new folder"),
    trLater("is no folder: name a new one for the {}"),
    trLater("holds something that is no {}, and would be replaced: name a new folder"),
    trLater("is there already: name a new folder"),
    trLater("the folder holds something already: name a new one"), trLater("publishing was stopped"),
    trLater("writing the bundle was stopped"), trLater("writing OpenEXR files was stopped"),
    trLater("writing glTF was stopped"), trLater("tracing pictures was stopped"),
    trLater("tracing panoramas was stopped"),
    trLater("{}: run `acentric bake {}` first, or export what there is with --allow-missing"),
    trLater("{} of {} captures is not baked yet"), trLater("{} of {} captures are not baked yet"),
    trLater("{} of {} captures and the light of near surfaces are not baked yet"),
    trLater("the light of near surfaces is not baked yet"),
    trLater("{} of the {} captures of region {} are not baked yet"),
    trLater("nothing is baked yet; run `acentric bake` on it first"),
    trLater("the scene and its light take {} MB: no picture's captures are there and fit beside them in {} "
            "MB. Allow more, or bake fewer samples per degree"),
    trLater("there is no region {}"), trLater("there is no such region"), trLater("the walk has no region"),
    trLater("pictures must have 16 to 8192 pixels a side"),
    trLater("textures must have {} to {} pixels a side"),
    trLater("WebP textures have at most {} pixels a side"), trLater("the colour quality is 0 to {}"),
    trLater("has no planes of surfaces: turn silhouettes on in the bake settings, and bake it again"),
    trLater("would be larger than the 4 GB that a GLB can have: compress meshes and textures"),
    trLater(
        "a texture of {} x {} pixels exceeds the {} a side that WebP can have: scale it down, or take PNG"),
    trLater("a PNG cannot be written: {}"), trLater("cannot be written: is the disk full?"),
    trLater("the viewer's page is not built: run `npm ci && npm run build` in the folder web of the sources "
            "(./run web does so), or install it to {}"),
    trLater("would be larger than the {} MB that browsers open: export a folder, or bake fewer samples per "
            "degree"),
    trLater("{}: open {} in a browser yourself"), trLater("no such file or folder"),
    trLater("no port can be had for a local web server"),
    trLater("port {} cannot be had: another program uses it, or may alone"),
    // Paths: engine/pipeline/camera_path, foreign_paths
    trLater("holds no pose"), trLater("a path begins at 0 \"seconds\""),
    trLater("\"seconds\" must be more than those of the pose before"),
    trLater("either all poses have \"seconds\" or none"), trLater("holds no frame"),
    trLater("more than {} frames"), trLater("needs \"eye\": [x, y, z]"),
    trLater("\"eye\" must be three numbers in metres"),
    trLater("\"yaw\" and \"pitch\" must be numbers in degrees"), trLater("\"seconds\" must be a number"),
    trLater("\"eye\" is out of range"), trLater("\"yaw\" is out of range"),
    trLater("\"pitch\" must lie in -90..90 degrees"), trLater("\"seconds\" must lie in 0..21600 (6 hours)"),
    trLater("must be four rows of four numbers"),
    trLater("line {}: must be IMAGE_ID QW QX QY QZ TX TY TZ CAMERA_ID NAME"),
    // Sweeps and presets: engine/measure, engine/pipeline/knobs
    trLater("is no sweep that this version reads"), trLater("is not a sweep's file: {}"),
    trLater("there is no knob '{}'; there are {}"), trLater("{} is given twice"),
    trLater("has no presets: `acentric sweep` finds them"),
    trLater("has no preset '{}': nothing was measured yet"), trLater("has no preset '{}', but {}"),
    trLater("'{}' is not {}"),
    // Where in a walk
    trLater("storey {}, camera {}"), trLater("storey {}, region {}"), trLater("the capture of camera {}")};

}  // namespace acentric::editor
