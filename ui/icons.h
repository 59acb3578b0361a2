#pragma once
/// Pictures on buttons: code points of Fork Awesome (https://forkaweso.me, SIL Open Font License 1.1), which
/// Debian packages as fonts-fork-awesome. Only those that are used: no others are in the atlas.

#include <imgui.h>

namespace acentric::ui {

enum class Icon : ImWchar {
  none = 0,
  adjust = 0xf042,  ///< a disc, half of it filled
  arrows = 0xf047,
  arrowsAcross = 0xf07e,
  barChart = 0xf080,
  binoculars = 0xf1e5,
  brush = 0xf1fc,
  bullseye = 0xf140,
  calculator = 0xf1ec,
  camera = 0xf030,
  clone = 0xf24d,  ///< a sheet upon another
  columns = 0xf0db,
  corners = 0xf248,  ///< frames with handles
  crosshairs = 0xf05b,
  expand = 0xf065,
  eyeSlashed = 0xf070,
  files = 0xf0c5,
  flag = 0xf024,
  grid = 0xf00a,
  home = 0xf015,
  listing = 0xf022,
  map = 0xf278,
  pause = 0xf04c,
  person = 0xf21d,  ///< standing in a ring
  picture = 0xf03e,
  play = 0xf04b,
  pointer = 0xf245,
  question = 0xf128,
  repeat = 0xf01e,
  road = 0xf018,
  scissors = 0xf0c4,
  sector = 0xf09e,
  share = 0xf1e0,
  sliders = 0xf1de,
  stop = 0xf04d,
  table = 0xf0ce,
  videoCamera = 0xf03d,
};

/// All of them but `none`.
inline constexpr Icon kIcons[] = {Icon::adjust,     Icon::arrows,   Icon::arrowsAcross, Icon::barChart,
                                  Icon::binoculars, Icon::brush,    Icon::bullseye,     Icon::calculator,
                                  Icon::camera,     Icon::clone,    Icon::columns,      Icon::corners,
                                  Icon::crosshairs, Icon::expand,   Icon::eyeSlashed,   Icon::files,
                                  Icon::flag,       Icon::grid,     Icon::home,         Icon::listing,
                                  Icon::map,        Icon::pause,    Icon::person,       Icon::picture,
                                  Icon::play,       Icon::pointer,  Icon::question,     Icon::repeat,
                                  Icon::road,       Icon::scissors, Icon::sector,       Icon::share,
                                  Icon::sliders,    Icon::stop,     Icon::table,        Icon::videoCamera};

}  // namespace acentric::ui
