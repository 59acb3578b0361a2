#include "engine/serve/folder_server.h"

#include <fmt/format.h>
#include <httplib.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <mutex>
#include <string_view>
#include <thread>
#include <vector>

#include "engine/base/file.h"

namespace acentric {
namespace {

namespace fs = std::filesystem;
using Answer = httplib::Server::HandlerResponse;

constexpr const char* kHost = "127.0.0.1";
/// A browser opens six connections to a host, and a thread waits on each.
constexpr std::size_t kThreads = 24;
constexpr int kIdleSeconds = 1, kWriteSeconds = 10;
constexpr std::size_t kRequestsEach = 10'000;  ///< of a connection
constexpr std::size_t kLargestText = std::size_t(64) << 20, kChunk = std::size_t(1) << 16;
constexpr double kMostMilliseconds = 1e8;

struct Type {
  std::string_view ending;
  const char* name;
};
constexpr std::array kTypes{Type{".html", "text/html; charset=utf-8"},
                            Type{".js", "text/javascript; charset=utf-8"},
                            Type{".css", "text/css; charset=utf-8"},
                            Type{".json", "application/json"},
                            Type{".png", "image/png"},
                            Type{".jpg", "image/jpeg"},
                            Type{".avif", "image/avif"},
                            Type{".svg", "image/svg+xml"},
                            Type{".wasm", "application/wasm"}};

const char* typeOf(const fs::path& file) {
  const auto found = std::ranges::find(kTypes, file.extension().string(), &Type::ending);
  return found == kTypes.end() ? "application/octet-stream" : found->name;
}

/// As most hosts do with it, it is sent compressed.
bool isText(std::string_view type) { return type.starts_with("text/") || type == "application/json"; }

/// Does a request name this machine? Else a site whose name was made to lead here could read what is served.
bool isLocal(const std::string& host) {
  const std::size_t port = host.find(':');
  const std::string name = host.substr(0, port);
  return name == kHost || name == "localhost";
}

/// With all links followed; nothing where it is no file, or lies outside.
std::optional<fs::path> fileWithin(const fs::path& folder, const std::string& name) {
  std::error_code error;
  const fs::path root = fs::canonical(folder, error);
  if (error) return std::nullopt;
  const fs::path file = fs::canonical(root / name, error);
  if (error || !fs::is_regular_file(file, error)) return std::nullopt;
  if (std::ranges::mismatch(root, file).in1 != root.end()) return std::nullopt;
  return file;
}

void answerText(httplib::Response& response, int status, const char* text) {
  response.status = status;
  response.set_content(std::string(text) + "\n", "text/plain");
}

}  // namespace

struct FolderServer::Impl {
  explicit Impl(ServeOptions given) : options(std::move(given)) {}

  /// Nothing where it is not served.
  std::optional<fs::path> find(const std::string& path) const {
    if (!path.starts_with('/') || path.find('\0') != std::string::npos) return std::nullopt;
    std::string name = path.substr(1);
    if (name.empty() || name.ends_with('/')) name += "index.html";
    if (oneFile) {
      if (name == options.subject.filename().string()) return options.subject;
    } else if (auto found = fileWithin(options.subject, name)) {
      return found;
    }
    return options.page.empty() ? std::nullopt : fileWithin(options.page, name);
  }

  /// The library answers ranges as they are asked for, also beyond the end of a file.
  Answer answer(const httplib::Request& request, httplib::Response& response) {
    auto& mine = const_cast<httplib::Request&>(request);  // made by the library for this call
    const httplib::Ranges ranges = std::exchange(mine.ranges, {});
    // Of the encodings that the library knows, Brotli takes seconds for the page's script.
    if (request.get_header_value("Accept-Encoding").find("gzip") != std::string::npos) {
      mine.headers.erase("Accept-Encoding");
      mine.headers.emplace("Accept-Encoding", "gzip");
    }
    response.set_header("Cache-Control", "no-store");
    response.set_header("X-Content-Type-Options", "nosniff");
    if (!isLocal(request.get_header_value("Host"))) {
      answerText(response, 403, "this server is for 127.0.0.1 and localhost alone");
    } else if (request.method != "GET" && request.method != "HEAD") {
      response.set_header("Allow", "GET, HEAD");
      answerText(response, 405, "GET and HEAD alone");
    } else if (request.path == kReportPath) {
      report(request);
      response.status = 204;
    } else if (const auto file = find(request.path)) {
      if (request.has_param(kReportParameter)) beginLoad();
      ++requests;
      send(*file, ranges, mine, response);
    } else {
      ++requests;
      answerText(response, 404, "not found");
    }
    return Answer::Handled;
  }

  void send(const fs::path& file, const httplib::Ranges& ranges, httplib::Request& request,
            httplib::Response& response) {
    std::error_code error;
    const std::uintmax_t size = fs::file_size(file, error);
    if (error) return answerText(response, 404, "not found");
    const char* const type = typeOf(file);
    response.set_header("Accept-Ranges", "bytes");
    if (ranges.size() == 1) {  // of several, all of the file is sent
      auto [first, last] = ranges.front();
      const auto end = ssize_t(size);
      if (first < 0) first = last < 0 ? end : std::max<ssize_t>(0, end - last), last = end - 1;
      if (last < 0 || last >= end) last = end - 1;
      if (first >= end || first > last) {
        response.status = 416;
        response.set_header("Content-Range", fmt::format("bytes */{}", size));
        return;
      }
      request.ranges = {{first, last}};
    } else if (isText(type) && size <= kLargestText) {
      const auto text = readText(file, kLargestText);
      if (!text) return answerText(response, 404, "not found");
      return response.set_content(*text, type);
    }
    if (size == 0) return response.set_content(std::string(), type);
    const auto stream = std::make_shared<std::ifstream>(file, std::ios::binary);
    if (!*stream) return answerText(response, 404, "not found");
    response.set_content_provider(
        std::size_t(size), type,
        [this, stream, chunk = std::vector<char>(std::min<std::size_t>(kChunk, size))](
            std::size_t offset, std::size_t length, httplib::DataSink& sink) mutable {
          const std::size_t count = std::min(length, chunk.size());
          stream->seekg(std::streamoff(offset));
          if (stopping || !stream->read(chunk.data(), std::streamsize(count))) return false;
          bytes += count;
          return sink.write(chunk.data(), count);
        });
  }

  void beginLoad() {
    bytes = 0;
    requests = 0;
    const std::lock_guard lock(mutex);
    load.reset();
  }

  void report(const httplib::Request& request) {
    const double milliseconds = std::strtod(request.get_param_value("ms").c_str(), nullptr);
    if (!(milliseconds >= 0 && milliseconds <= kMostMilliseconds)) return;
    const PageLoad now{milliseconds / 1000, bytes, requests};
    {
      const std::lock_guard lock(mutex);
      load = now;
    }
    if (options.loaded) options.loaded(now);
  }

  ServeOptions options;
  bool oneFile = false;
  int port = 0;
  std::string address;
  std::atomic<std::uint64_t> bytes = 0;  // since a page was asked for that reports
  std::atomic<int> requests = 0;
  std::atomic<bool> stopping = false;
  mutable std::mutex mutex;  // of load
  std::optional<PageLoad> load;
  httplib::Server server;
  std::jthread listening;
};

FolderServer::FolderServer(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}

FolderServer::~FolderServer() {
  impl_->stopping = true;
  impl_->server.stop();
}

Result<std::unique_ptr<FolderServer>> FolderServer::start(ServeOptions options) {
  std::error_code error;
  const fs::file_status status = fs::status(options.subject, error);
  if (!fs::exists(status))
    return fail(ErrorKind::notFound, "no such file or folder", options.subject.string());
  auto impl = std::make_unique<Impl>(std::move(options));
  impl->oneFile = !fs::is_directory(status);
  httplib::Server& server = impl->server;
  // The library's own choice would let two servers share a port.
  server.set_socket_options([](socket_t socket) {
    const int yes = 1;
    ::setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
  });
  server.new_task_queue = [] { return new httplib::ThreadPool(kThreads); };  // the library deletes it
  server.set_keep_alive_timeout(kIdleSeconds).set_keep_alive_max_count(kRequestsEach);
  server.set_write_timeout(kWriteSeconds).set_tcp_nodelay(true);
  server.set_pre_routing_handler(
      [impl = impl.get()](const httplib::Request& request, httplib::Response& response) {
        return impl->answer(request, response);
      });
  // Called once the body is compressed and before it is sent: what a client has got is counted.
  server.set_post_routing_handler(
      [impl = impl.get()](const httplib::Request& request, const httplib::Response& response) {
        if (request.method != "HEAD") impl->bytes += response.body.size();
      });
  const int wanted = impl->options.port;
  impl->port = wanted == 0                          ? server.bind_to_any_port(kHost)
               : server.bind_to_port(kHost, wanted) ? wanted
                                                    : -1;
  if (impl->port <= 0)
    return fail(ErrorKind::unreadable,
                wanted == 0
                    ? "no port can be had for a local web server"
                    : fmt::format("port {} cannot be had: another program uses it, or may alone", wanted));
  impl->address = fmt::format("http://{}:{}/", kHost, impl->port);
  if (impl->oneFile) impl->address += "?walk=" + percentEncoded(impl->options.subject.filename().string());
  impl->listening = std::jthread([&server] { server.listen_after_bind(); });
  while (!server.is_running()) std::this_thread::yield();  // else it could not be stopped
  return std::unique_ptr<FolderServer>(new FolderServer(std::move(impl)));
}

int FolderServer::port() const { return impl_->port; }

const std::string& FolderServer::address() const { return impl_->address; }

std::string FolderServer::reportingAddress() const {
  return impl_->address + (impl_->oneFile ? "&" : "?") + kReportParameter;
}

std::optional<PageLoad> FolderServer::lastLoad() const {
  const std::lock_guard lock(impl_->mutex);
  return impl_->load;
}

std::string percentEncoded(const std::string& text) {
  constexpr std::string_view kPlain = "-._~";
  std::string encoded;
  for (const char c : text) {
    const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                       kPlain.find(c) != std::string_view::npos;
    encoded += plain ? std::string(1, c) : fmt::format("%{:02X}", static_cast<unsigned char>(c));
  }
  return encoded;
}

}  // namespace acentric
