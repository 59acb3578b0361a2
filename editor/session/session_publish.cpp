/// Session's dealings with publishing: what of which project, and where.

#include <algorithm>

#include "editor/session/session.h"
#include "ui/translate.h"

namespace acentric::editor {

PublishPlace Session::publishPlace() const {
  const auto known = std::ranges::find(preferences_.published, file_, &RememberedPlace::project);
  return known != preferences_.published.end() ? known->place : PublishPlace{suggestedPublishFolder(file_)};
}

void Session::keepPublishPlace(const PublishPlace& place) {
  if (!hasProject() || shipped_ || place == publishPlace()) return;
  preferences_.rememberPublished(file_, place);
  savePreferencesNow();
}

std::string Session::linkToWalk() const {
  const std::string address = hasProject() ? publishPlace().publicAddress : std::string();
  return address.empty() ? publishing_.address() : address;
}

void Session::publish(const PublishPlace& place, bool allowMissing) {
  if (!built_ || rebuilding_.running() || walkRefuses(tr("Publishing"))) return;
  keepPublishPlace(place);
  publishing_.publish(built_, place, allowMissing, options_.importHost, bakeThreads());
}

}  // namespace acentric::editor
