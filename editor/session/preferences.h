#pragma once
/// What the editor remembers between runs: $XDG_CONFIG_HOME/acentric/editor.json (else ~/.config). A file
/// that cannot be read, or is damaged, is as none (and told of); unknown or wrong values are left at their
/// defaults.

#include <filesystem>
#include <string>
#include <vector>

#include "engine/base/result.h"

namespace acentric::editor {

enum class Theme { dark, light };
/// What the editor opens when no file is named.
enum class StartUp { sample, lastProject, nothing };

/// What draws walks whose project says list priority.
enum class Graphics {
  automatic,  ///< the graphics card where it draws the same in less time (graphics_trial.h)
  processor,
  card,  ///< also a slow one
};

/// Where a project is published, and how.
struct PublishPlace {
  std::filesystem::path folder;
  bool oneFile = false;     ///< a walk's file, in place of a bundle's many
  bool openBrowser = true;  ///< once it is published
  /// Where the folder is put for others, which links begin with; empty: this machine's server.
  std::string publicAddress = {};
  bool operator==(const PublishPlace&) const = default;
};
struct RememberedPlace {
  std::filesystem::path project;
  PublishPlace place;
};

struct Preferences {
  static constexpr std::size_t kMostRecent = 10, kMostPublished = 50;
  static constexpr int kLeastScalePercent = 75, kMostScalePercent = 200;
  static constexpr double kLeastAutosaveSeconds = 5, kMostAutosaveSeconds = 3600;
  static constexpr float kLeastShare = 0.2F;  ///< of the window, that one of four views keeps
  static constexpr double kLeastLookSensitivity = 0.1, kMostLookSensitivity = 5;

  std::vector<std::filesystem::path> recent;  ///< projects, newest first
  std::filesystem::path lastFolder;
  std::vector<RememberedPlace> published;  ///< newest first; by project, where that is not the usual place
  int bakeThreads = 0;                     ///< 0 = all but one
  int bakeMegabytes = 1536;                ///< that what is baked may take until it is written
  int walkMegabytes = 0;                   ///< for captures of the walk in memory; 0 = half of the machine's
  double walkMetresPerSecond = 1.4;
  int historyMegabytes = 256;          ///< for what can be undone
  bool reimportAutomatically = false;  ///< a model that changed on disk, without being asked
  Graphics graphics = Graphics::automatic;
  double lookSensitivity = 1;  ///< of the mouse; 1 turns 0.2° a pixel
  bool invertLook = false;     ///< moving the mouse up looks down
  double autosaveSeconds = 20;
  Theme theme = Theme::dark;
  std::string language = {};  ///< a code of ui/translate.h; empty: the system's
  int scalePercent = 0;       ///< of the interface; 0 = as the display asks
  StartUp startUp = StartUp::sample;
  bool guideSeen = false;     ///< the guided start is not shown by itself any more
  float settingsWidth = 324;  ///< pixels of a display with 96 dpi, as the two below
  float walkWidth = 600;
  float bottomHeight = 214;
  bool showSettings = true;  ///< beside the plan and the walk
  bool showBottom = true;    ///< below them: bake, scene, messages
  bool fourViews = false;    ///< plan, walk, 3D and accuracy at once, in place of panels
  float fourColumn = 0.5F;   ///< share of the left views
  float fourRow = 0.5F;      ///< of the upper ones

  void addRecent(const std::filesystem::path& file);
  void rememberPublished(const std::filesystem::path& project, const PublishPlace& place);
  /// All that the preferences dialog shows, as it was at first; files and the window's layout stay.
  void resetSettings();
  void resetLayout();
  void keepLayoutOf(const Preferences& other);
};

/// What to open when no file is named; empty = nothing. `sample` may be empty: there is none.
std::filesystem::path startUpFile(const Preferences& preferences, const std::filesystem::path& sample);
std::filesystem::path preferencesFile();
/// `problem` is told what was wrong with a file that is there but cannot be used; it is put aside.
Preferences loadPreferences(const std::filesystem::path& file, std::string* problem = nullptr);
Status savePreferences(const Preferences& preferences, const std::filesystem::path& file);

}  // namespace acentric::editor
