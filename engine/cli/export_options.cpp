/// Bundles for other programs.

#include "engine/cli/command_line.h"

namespace acentric::cli {

void addExportCommand(CLI::App& app, Chosen& chosen) {
  auto [c, o] = add(
      app, chosen, "export", "Write what is baked for other programs to walk through",
      "  acentric export kitchen.acentric.json --to bundle kitchen-bundle\n"
      "  acentric export kitchen.acentric.json --to web kitchen-web    # for any web server\n"
      "  acentric export kitchen.acentric.json --to web --single-file kitchen.html\n"
      "  acentric export kitchen.acentric.json --to walk kitchen.acentric      # one file, read by ranges\n"
      "  acentric export kitchen.acentric.json --to gltf kitchen-gltf\n"
      "  acentric export kitchen.acentric.json --to 3dtiles kitchen-tiles",
      runExport);
  c->add_option("project", o.project, "Project file")->required();
  c->add_option(
       "output", o.output,
       "Folder to write: a new one, or one to replace that holds the same; of --to walk a file, with "
       "--single-file an HTML file")
      ->required();
  addChoice(
      *c, "--to", o.to,
      "What to write: bundle, a folder for runtimes (engine/export/FORMAT.md); web, the same with a page "
      "that walks through it (docs/web.md); walk, a bundle as one file that is read by ranges; gltf, a GLB "
      "for each region (docs/gltf.md); 3dtiles, the same as 3D Tiles 1.1; exr, what each camera saw as "
      "OpenEXR (engine/store/FORMAT.md); colmap, nerfstudio, seurat, ray-traced pictures with distances "
      "and their cameras; panoramas, OpenEXR with distances",
      {"bundle", "web", "walk", "gltf", "3dtiles", "exr", "colmap", "nerfstudio", "seurat", "panoramas"});
  c->add_option(
       "--colour-quality", o.colourQuality,
       "bundle, web and walk: how true captures' colours are, 0 to 99 as they are shown, 100 every bit; "
       "unless given, 92, or less where the project says so. Of WebP textures: the same by its own scale")
      ->check(CLI::Range(0, kLosslessColours));
  addNumber(*c, "--regions-per-page", o.regionsPerPage,
            "walk: regions that a page of its index tells of; a viewer reads the pages that it comes to", 1,
            4096);
  addNumber(*c, "--texture-size", o.texturePixels, "gltf and 3dtiles: most pixels a side of a texture", 128,
            16384);
  c->add_option("--mesh-compression", o.meshCompression,
                "gltf and 3dtiles: none, or meshopt, for programs that read EXT_meshopt_compression "
                "(docs/gltf.md); unless given, none of gltf and meshopt of 3dtiles")
      ->check(CLI::IsMember({"none", "meshopt"}));
  c->add_option("--texture-format", o.textureFormat,
                "gltf and 3dtiles: png, or webp, for programs that read EXT_texture_webp (docs/gltf.md); "
                "unless given, png of gltf and webp of 3dtiles")
      ->check(CLI::IsMember({"png", "webp"}));
  c->add_option("--region", o.region, "gltf, 3dtiles and pictures: this region alone")
      ->check(CLI::NonNegativeNumber);
  addNumber(*c, "--face-size", o.facePixels,
            "colmap, nerfstudio, seurat: pixels a side of a cube's face; panoramas are four times as wide",
            16, 8192);
  c->add_flag("--single-file", o.singleFile, "Of --to web: everything in one HTML file, for small projects");
  c->add_flag("--allow-missing", o.allowMissing,
              "Write what there is though captures or light are not baked yet");
}

void addServeCommand(CLI::App& app, Chosen& chosen) {
  auto [c, o] = add(app, chosen, "serve", "Serve a published walk to browsers on this machine",
                    "  acentric serve kitchen-web --open\n"
                    "  acentric serve kitchen.acentric --port 8080",
                    runServe);
  c->add_option("subject", o.subject,
                "Folder to serve, as `export --to web` writes one, or a walk's file; what a bundle or a walk "
                "lacks of the page is taken from where it is installed or built")
      ->required();
  c->add_option("--port", o.port,
                "Port on 127.0.0.1; 0 is any that is free (default: 8000, or one that is free)")
      ->check(CLI::Range(0, 65535));
  c->add_flag("--open", o.open, "Open it in the browser, and tell how long its first frame took");
}

}  // namespace acentric::cli
