#pragma once
/// Errors of files, projects, layouts and baking; improvements that are predicted for a picture.

#include <array>

#include "ui/translate.h"

namespace acentric::editor {

/// Each "{}" stands for any text, also for another error or a part of one.
inline constexpr std::array kErrors = {
    // ScaleDoubt::text
    trLater("As the model is scaled now, {}; at {} metres per unit that would be {}"),
    trLater("As the model is scaled now, {} and {}; at {} metres per unit these would be {} and {}"),
    trLater("it is {} across"), trLater("its steps are {} high"), trLater("its doorways are {} high"),
    trLater("its storeys are {} high"), trLater("the spaces between its floors and ceilings are {} high"),
    // Files: engine/base
    trLater("holds a NUL character, which no file name does"), trLater("is a folder, not a file"),
    trLater("is larger than the limit of {} MiB"), trLater("cannot be opened for reading"),
    trLater("cannot be opened for reading: {}"), trLater("reading failed"), trLater("reading failed: {}"),
    trLater("cannot be opened for writing: {}"), trLater("writing failed: {}"),
    trLater("writing was stopped"), trLater("cannot be opened to flush it to disk: {}"),
    trLater("flushing to disk failed: {}"), trLater("folder cannot be made: {}"),
    trLater("cannot be put in place: a folder has this name; move it away"),
    trLater("cannot be put in place: {}"), trLater("nothing can be written there: {}"),
    trLater("has no known free space: {}"), trLater("is not a regular file"), trLater("cannot be mapped: {}"),
    trLater("cannot be copied to {}: {}"), trLater("cannot be started: {}"),
    trLater("is nested more than {} levels deep"), trLater("is not JSON that can be read: {}"),
    trLater("not enough memory"),
    // Projects: engine/pipeline/schema_check, project_file, project_walks, project_lock
    trLater("must be {}, not {}"), trLater("must be one of {}, not {}"),
    trLater("must be at least {}, not {}"), trLater("must be at most {}, not {}"),
    trLater("must have {} {}, not {}"), trLater("must have at least {} {}, not {}"),
    trLater("must have at most {} {}, not {}"), trLater("has \"{}\", which is none of the fields here: {}"),
    trLater("must have just one of {}"), trLater("is not what the schema asks for"),
    trLater("there must be 1 to {} storeys, not {}"), trLater("there is no storey {}"),
    trLater("names none of the storeys"), trLater("must have 1 to {} bytes"),
    trLater("'{}' is the name of another storey too"), trLater("'{}' is the name of another one too"),
    trLater("must hold finite numbers"), trLater("names no model file"),
    trLater("the name of the model is not UTF-8, and a project file cannot state it; rename the model"),
    trLater("{} leaves the project's folder; `acentric collect PROJECT` brings the model into it"),
    trLater("must be 0 (no limit) or more"), trLater("must lie above 0 and up to 10"),
    trLater("must lie in 1..179"), trLater("must be a positive number"),
    trLater("{} was written by a newer Acentric; this one reads version 1"),
    trLater("freeApvs: two of them have the number {}"), trLater("needs a time after the pose before it"),
    trLater("is no lock that could be read"), trLater("cannot be written"),
    trLater("The last editor on this project ended without closing it: {}"),
    trLater("The lock beside the project was damaged and is replaced: {}"),
    trLater("Other editors will not notice that the project is open here. {}"),
    trLater("The last bake of this project ended before it had finished: {}"),
    trLater("Other bakes of this project will not notice this one. {}"),
    trLater("{} on {} since {} (process {})"),
    // New projects and models: engine/pipeline/new_project, collect_model, storeys
    trLater("give either a storey or an outline, not both"), trLater("the outline lies outside the scene"),
    trLater("no region fits the outline; draw a larger one or choose smaller cells"),
    trLater("eye height must lie in (0, 1000] metres"),
    trLater("minutes of baking must lie in [0, 1e6]; 0 is no limit"),
    trLater("give either an outline or a place to lay out around, not both"), trLater("no such model file"),
    trLater("{} cameras are too few for a single region; allow more (--max-cameras)"),
    trLater("there are too many models of this name"), trLater("is not there any more"),
    trLater("a link to the model cannot be made: {}"), trLater("lies outside the project's folder, {}"),
    trLater("what files it names is not known, since imports cannot be kept: link to it, or bring it into "
            "the project's folder yourself"),
    trLater("its {} pieces are more than the {} storeys that a project may have let"),
    trLater("no stairs or ramp that can be walked join '{}' and '{}'"),
    trLater("no way is found there at a closer look"),
    trLater("the way from {} to {} m is {} x {} m large; stairs take up to {} m2 of the plan"),
    trLater("a piece of stairs rises {} m; it must lie in 0.02..10 m"),
    // Layouts: engine/layout
    trLater("{} is {}; it must lie in {}..{}"),
    trLater("the {} region {} does not exist in configuration {}; take it off the list"),
    trLater("the {} region {} lies farther than {} m out; take it off the list"),
    trLater("the {} region {} is part of {}, which is not split; split that, or take this off the list"),
    trLater("the density of the region {}"),
    trLater("{} regions have a density of their own; at most {} can"),
    trLater("free APV {} has a density, but there is none of that number"),
    trLater("{} free APVs, at most {} can be"), trLater("free APV {}: {}"),
    trLater("free APV {} lies farther than {} m out"),
    trLater("free APV {} has an offset of {} m; it must be 0 (a traditional panorama) or lie in {}..{}"),
    trLater("more than {} free APVs: choose larger cells, or place panoramas one by one"),
    trLater("centre and offset must be finite"),
    trLater("a field of view of {} degrees: it must lie in 1..120"),
    trLater("360 is no whole multiple of a field of view of {} degrees; try {}"),
    trLater("there is no configuration '{}'; choose one of a, b, c, d, e, f, g"),
    trLater("the configuration is not one of a to g"),
    trLater("outline loop {} has {} points; it needs at least 3"),
    trLater("outline loop {} has the point ({}, {}); coordinates must lie within {} m"),
    trLater("the outline has {} points, more than {}; simplify it"),
    trLater("regions of configuration {} cannot be split; only those of e and g can"),
    trLater("the region {} is split once more than {} times"),
    trLater("{} regions are split; at most {} can be"),
    trLater("{} regions are added and {} removed one by one; at most {} of each can be. Edit the outline "
            "instead"),
    trLater("about {} regions would be placed, at most {} can be: choose cells of {} m or more (now {} m), "
            "or a smaller outline"),
    // Outlines and placement: engine/geometry, engine/inspect
    trLater("'{}' is not a finite number; write points as x,y;x,y;x,y in metres"),
    trLater("'{}' is not a point; write points as x,y;x,y;x,y in metres"),
    trLater("loop {} has {} different points; a loop needs at least 3"),
    trLater("encloses no area; give the corners of a walkable floor in order"),
    trLater("{} is {} m; it must lie in {}..{} m"), trLater("the floor height must be finite, or left out"),
    trLater("the scene has no extent in plan, so there is no floor to walk on"),
    trLater("a grid step of {} m makes {} points, more than {}; choose {} m or more"),
    trLater("{}; lower the eye height, or give the floor height or the outline yourself"),
    trLater("no surface has {} m of room above it and {} m to the sides"),
    trLater("no place at height {} m has {} m of room above it and {} m to the sides"),
    trLater("no floor of {} m2 has {} m of room above it; lower the eye height or the least area"),
    trLater("the least share of a storey's area must lie in 0..1"),
    trLater("the least area of a storey must be 0 m2 or more"),
    trLater("the budget must be at least one triangle per region"),
    trLater("the smallest cell must be {} to {} m, not {}"),
    trLater("the largest cell must be {} to {} m, not {}"), trLater("2 to 200 sizes can be tried, not {}"),
    trLater("1 to 90 rotations can be tried, not {}"),
    trLater("1 to 16 origins along an axis can be tried, not {}"),
    trLater("there is no walkable outline to lay cells over: draw one first"),
    trLater("there is no walkable outline to stand in: draw one"),
    trLater("cells of configuration {} cannot be split, only those of e (squares) and g (triangles): choose "
            "one of these, or fit the size of all cells"),
    trLater("the share that a split must gain must be 0 to 1, not {}"),
    trLater("the {} is {} m; it must lie in 0..100 m"),
    trLater("nothing stands about anywhere on this ground"), trLater("the scene has no surface to judge"),
    trLater("the scene has no surface to be seen"), trLater("no surface is seen from the walkable area"),
    // Bake settings: engine/bake/bake_settings
    trLater("{} samples per degree: must lie in 0.5..64"), trLater("{} ambient rays: must lie in 0..1024"),
    trLater("{} shadow rays: must lie in 1..1024"), trLater("{} bounces: must lie in 1..8"),
    trLater("ambient radius {} m: must lie in {}..{}"), trLater("surface texel {} m: must lie in {}..{}"),
    trLater("{} test eyes: must lie in 1..{}"),
    trLater("pruning may lose {} of what is seen: must be 0 or lie in {}..1"),
    trLater("eye range {} m: must lie in 0..{}"),
    trLater("distances that shift pictures by {} samples: must lie in 0..{}"),
    trLater("colours of quality {}: must lie in 0..{}"), trLater("{} layers: must lie in 1..64"),
    // Baking: engine/bake, engine/pipeline/bake_*, estimate_bake
    trLater("no camera {}: the layout has cameras 0..{}"),
    trLater("there is no camera {}; the layout has {}"), trLater("the bake was stopped"),
    trLater("not enough memory to bake; lower the samples per degree"),
    trLater("not enough memory for this capture; lower the samples per degree"),
    trLater("more than 2^31 samples in one capture; lower the samples per degree"),
    trLater("not enough memory to write a capture"), trLater("writing a capture failed: {}"),
    trLater("not enough memory to make the scene traceable; simplify it or close other programs"),
    trLater("not enough memory to make the scene traceable"),
    trLater("Embree refused the scene: {} (error {})"),
    trLater("this Embree was built without ray masks or filter functions; install Debian's"),
    trLater("surface light has {} samples with one at each corner of what regions draw, and at most {} can "
            "be. Draw a smaller outline, choose a smaller near band, or simplify the scene"),
    trLater("not enough memory for surface light; raise the surface texel"),
    trLater("{}; what is finished is kept: make room and bake again"),
    trLater("{}; make the folder writable, or bake a copy of the project and its model in one that is"),
    trLater("about {} MB are needed for previews and captures, {} MB are free: make room, bake fewer "
            "cameras, or lower the samples per degree"),
    trLater("about {} MB are needed, {} MB are free: make room, bake fewer cameras, or lower the samples per "
            "degree"),
    trLater("the bake was taken over by {}; what it had finished is kept"),
    trLater("the model changed while it was baked: the captures that were finished are kept, but are of the "
            "model as it was; bake again"),
    trLater("the bytes to be taken are less than what must be there anyway"),
    trLater("the estimate was stopped"),
    trLater("not enough memory for an estimate; lower the samples per degree"),
    trLater("of {} instances {} triangles lie in the walk's regions or within the near band around them, "
            "where walks draw each triangle; at most {} can be. Draw a smaller outline, choose a smaller "
            "near band, or give the instances fewer triangles"),
    // Questions to the picture: engine/pipeline/ask_picture
    trLater("({}, {}) is no pixel of a frame of {}x{}"), trLater("the frame is of another layout"),
    // Who bakes: engine/pipeline/bake_guard
    trLater("is being baked by {}; {}"), trLater("has the light on its surfaces baked by {}; {}"),
    trLater("has no \"{}\""),
    // Cells that stay above the budget: engine/inspect/refine
    trLater("its parts would be smaller than allowed"),
    trLater("splitting it further does not lower its worst part"), trLater("a free APV cannot be split"),
    trLater("more splits would give too many regions"),
    // Improvement::what and why, of engine/pipeline/ask_picture
    trLater("samples per degree {} to {}"), trLater("samples per degree here times {}"),
    trLater("split the cell ({}, {}) into four"), trLater("cell size {} to {}"),
    trLater("near band {} to {}"), trLater("layers {} to {}"),
    trLater("test eyes {} to {}, half the pruning loss"), trLater("surface texel {} to {}"),
    trLater("finer captures everywhere"), trLater("finer captures for this cell alone"),
    trLater("cameras nearer to the eye"), trLater("the surface is drawn as polygons"),
    trLater("more of what lies behind"), trLater("pruning looks from more places"),
    trLater("finer light on near surfaces")};

}  // namespace acentric::editor
