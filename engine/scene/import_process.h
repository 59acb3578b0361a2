#pragma once
/// Runs the importer program on one model, with limits on time and memory. Private to this folder.

#include "engine/scene/import.h"

namespace acentric {

/// The importer to run for `host`: the one named, else the one that is installed or built with the running
/// program: in ../libexec/acentric or beside it.
Result<std::filesystem::path> importerProgram(const ImportHost& host);

/// Returns when the importer has written `output`, or with the reason why it did not. The process is gone by
/// then.
Status runImporter(const std::filesystem::path& program, const std::filesystem::path& model,
                   const ImportOptions& options, const std::filesystem::path& output, const ImportHost& host,
                   const Progress& progress, std::stop_token stop);

}  // namespace acentric
