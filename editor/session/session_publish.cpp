/// Session's dealings with publishing: what of which project, and where.

#include <algorithm>

#include "editor/session/session.h"

namespace acentric::editor {

PublishPlace Session::publishPlace() const {
  const auto known = std::ranges::find(preferences_.published, file_, &RememberedPlace::project);
  return known != preferences_.published.end() ? known->place : PublishPlace{suggestedPublishFolder(file_)};
}

void Session::publish(const PublishPlace& place, bool allowMissing) {
  if (!built_ || rebuilding_.running() || walkRefuses("Publishing")) return;
  if (place != publishPlace()) {
    preferences_.rememberPublished(file_, place);
    savePreferencesNow();
  }
  publishing_.publish(built_, place, allowMissing, options_.importHost, bakeThreads());
}

}  // namespace acentric::editor
