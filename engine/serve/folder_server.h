#pragma once
/// A local web server of static files: a published folder, or a walk's file with the page that opens it. It
/// listens on 127.0.0.1 alone and answers GET and HEAD, also of one range of a file. Nothing outside what it
/// serves is sent, links that lead out of it included, and requests that name another host are refused, so
/// that no page of another site can read it. Nothing is to be kept by browsers: each load is a first one.
/// Requests are answered by threads of its own; its functions may be called from any thread.

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "engine/base/result.h"

namespace acentric {

/// Until a page reported its first frame.
struct PageLoad {
  double seconds = 0;       ///< measured by the page, from its beginning
  std::uint64_t bytes = 0;  ///< sent since it was asked for, as sent (text is compressed), without headers
  int requests = 0;
  bool operator==(const PageLoad&) const = default;
};

struct ServeOptions {
  std::filesystem::path subject;                ///< a folder, or a file
  std::filesystem::path page;                   ///< a folder for what the subject lacks; empty: none
  int port = 0;                                 ///< 0: any that is free
  std::function<void(const PageLoad&)> loaded;  ///< called by a thread of the server
};

class FolderServer {
 public:
  /// Fails where the subject is not there, or the port is taken.
  static Result<std::unique_ptr<FolderServer>> start(ServeOptions options);
  /// Stops; what is being sent is broken off. Takes a second where a browser holds its connection.
  ~FolderServer();
  FolderServer(const FolderServer&) = delete;
  FolderServer& operator=(const FolderServer&) = delete;

  int port() const;
  /// Of the page: "http://127.0.0.1:8000/"; of a file it names that: "...?walk=kitchen.acentric".
  const std::string& address() const;
  /// The same for a page that reports its first frame (kReportParameter).
  std::string reportingAddress() const;
  /// Of the page that was asked for last by a reporting address, once it has shown a frame. Where several
  /// load at once, the bytes are those of all.
  std::optional<PageLoad> lastLoad() const;

 private:
  struct Impl;
  explicit FolderServer(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

/// In the address of a page: it asks for kReportPath with `ms`, milliseconds, once its first frame shows.
inline constexpr const char* kReportParameter = "report";
inline constexpr const char* kReportPath = "/.acentric/first-frame";

/// Of an address: all but letters, digits and "-._~" as %XX.
std::string percentEncoded(const std::string& text);

}  // namespace acentric
