#include "engine/scene/scene_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <concepts>
#include <cstdio>
#include <cstring>
#include <memory>
#include <new>

#include "engine/base/file.h"
#include "engine/base/mapped_file.h"
#include "engine/scene/byte_stream.h"
#include "engine/scene/import.h"
#include "engine/scene/instances.h"
#include "engine/scene/packed_stream.h"

namespace acentric {
namespace {

constexpr char kMagic[8] = {'A', 'C', 'S', 'C', 'E', 'N', 'E', '\n'};
constexpr std::size_t kHeaderBytes = 64;
constexpr std::uint64_t kMaxUnpacked = std::uint64_t(64) << 30;
constexpr std::uint64_t kAlignment = 16;

constexpr std::uint64_t aligned(std::uint64_t bytes) {
  return (bytes + kAlignment - 1) / kAlignment * kAlignment;
}
/// That an array takes in the geometry.
constexpr std::uint64_t withPadding(std::uint64_t bytes) {
  return bytes == 0 ? 0 : aligned(bytes + MeshArray<std::byte>::kPadding);
}

struct Header {
  std::uint32_t version = kSceneFileVersion, zero = 0;
  std::uint64_t dependencyBytes = 0;
  std::uint64_t packedBytes = 0;
  std::uint64_t unpackedBytes = 0;
  std::uint64_t geometryBytes = 0;
  ContentKey checksum;

  std::uint64_t geometryStart() const { return aligned(kHeaderBytes + dependencyBytes + packedBytes); }
};

/// `hasher` has had what follows the header.
ContentKey checksumOf(const Header& header, Hasher& hasher) {
  return hasher.value(header.version)
      .value(header.dependencyBytes)
      .value(header.packedBytes)
      .value(header.unpackedBytes)
      .value(header.geometryBytes)
      .finish();
}

// What is written and read, field by field, by a ByteWriter or a ByteReader: `fields` of each type.

template <class T, class Of>
concept Any = std::same_as<std::remove_const_t<T>, Of>;

template <Any<Header> H>
void fields(auto& bytes, H& header) {
  bytes.value(header.version);
  bytes.value(header.zero);
  bytes.value(header.dependencyBytes);
  bytes.value(header.packedBytes);
  bytes.value(header.unpackedBytes);
  bytes.value(header.geometryBytes);
  bytes.value(header.checksum);
}

template <Any<Dependency> D>
void fields(auto& bytes, D& d) {
  bytes.text(d.path);
  bytes.small(d.exists, 1);
  bytes.value(d.size);
  bytes.value(d.modifiedNanoseconds);
  bytes.value(d.inode);
  bytes.value(d.content);
}

template <Any<TextureUse> T>
void fields(auto& bytes, T& use) {
  bytes.number(use.texture);
  bytes.small(use.uvSet, 1);
  bytes.value(use.transform);
}

template <Any<Material> M>
void fields(auto& bytes, M& m) {
  bytes.text(m.name);
  bytes.value(m.baseColour);
  fields(bytes, m.baseColourTexture);
  bytes.value(m.emissive);
  fields(bytes, m.emissiveTexture);
  bytes.value(m.metallic);
  bytes.value(m.roughness);
  fields(bytes, m.metallicRoughnessTexture);
  fields(bytes, m.normalTexture);
  bytes.value(m.normalScale);
  bytes.value(m.transmission);
  bytes.small(m.alphaMode, 2);
  bytes.value(m.alphaCutoff);
  bytes.small(m.doubleSided, 1);
  bytes.small(m.unlit, 1);
}

/// Hands all arrays of a mesh on, in the order of the file.
template <class AnyMesh, class Visit>
void forEachArray(AnyMesh& m, const Visit& visit) {
  visit(m.positions);
  visit(m.normals);
  visit(m.tangents);
  visit(m.uv[0]);
  visit(m.uv[1]);
  visit(m.colours);
  visit(m.triangles);
}

/// Lengths of arrays are in the scene, their contents in the geometry, one behind the other.
class SceneWriter : public ByteWriter {
 public:
  using ByteWriter::ByteWriter;
  template <class T>
  void geometry(const MeshArray<T>& array) {
    value(std::uint64_t(array.size()));
  }
};
class SceneReader : public ByteReader {
 public:
  SceneReader(Source source, std::uint64_t size, std::shared_ptr<const MappedFile> file, std::uint64_t start,
              std::uint64_t bytes)
      : ByteReader(std::move(source), size),
        file_(std::move(file)),
        geometry_(file_->bytes().subspan(start, bytes)) {}

  template <class T>
  void geometry(MeshArray<T>& array) {
    std::uint64_t size = 0;
    value(size);
    if (size > geometry_.size() / sizeof(T) || withPadding(size * sizeof(T)) > geometry_.size()) refuse();
    if (!sound() || size == 0) return;
    array = MeshArray<T>::mapped({reinterpret_cast<const T*>(geometry_.data()), std::size_t(size)}, file_);
    geometry_ = geometry_.subspan(withPadding(size * sizeof(T)));
  }
  bool atEnd() const { return ByteReader::atEnd() && geometry_.empty(); }

 private:
  std::shared_ptr<const MappedFile> file_;
  std::span<const std::byte> geometry_;
};

template <Any<Mesh> M>
void fields(auto& bytes, M& m) {
  bytes.text(m.name);
  bytes.number(m.material);
  forEachArray(m, [&](auto& array) { bytes.geometry(array); });
}

template <Any<Instance> I>
void fields(auto& bytes, I& i) {
  bytes.value(i.prototype);
  bytes.value(i.worldFromPrototype);
}

template <Any<Texture> T>
void fields(auto& bytes, T& t) {
  bytes.text(t.name);
  bytes.number(t.image);
  bytes.small(t.wrapU, 2);
  bytes.small(t.wrapV, 2);
  bytes.small(t.nearest, 1);
}

void fields(SceneWriter& out, const std::shared_ptr<const ColourImage>& image) {
  static const ColourImage kNone;
  const ColourImage& picture = image ? *image : kNone;
  out.number(picture.width);
  out.number(picture.height);
  out.array(picture.pixels);
}
void fields(SceneReader& in, std::shared_ptr<const ColourImage>& image) {
  ColourImage picture;
  in.number(picture.width);
  in.number(picture.height);
  in.array(picture.pixels);
  if (picture.width > 0 && picture.height > 0 &&
      std::size_t(picture.width) * std::size_t(picture.height) == picture.pixels.size())
    image = std::make_shared<const ColourImage>(std::move(picture));
}

template <Any<Light> L>
void fields(auto& bytes, L& l) {
  bytes.text(l.name);
  bytes.small(l.kind, 2);
  bytes.value(l.colour);
  bytes.value(l.intensity);
  bytes.value(l.position);
  bytes.value(l.direction);
  bytes.value(l.range);
  bytes.value(l.innerCone);
  bytes.value(l.outerCone);
  bytes.value(l.radius);
  bytes.value(l.angularRadius);
}

template <Any<std::string> S>
void fields(auto& bytes, S& line) {
  bytes.text(line);
}

void list(auto& bytes, auto& things) {
  bytes.each(things, [&](auto& thing) { fields(bytes, thing); });
}

template <Any<Scene> S>
void fields(auto& bytes, S& scene) {
  bytes.text(scene.name);
  bytes.value(scene.key);
  bytes.value(scene.parts);
  bytes.value(scene.origin);
  list(bytes, scene.materials);
  list(bytes, scene.meshes);
  list(bytes, scene.prototypes);
  list(bytes, scene.instances);
  list(bytes, scene.textures);
  list(bytes, scene.images);
  list(bytes, scene.lights);
  bytes.value(scene.sky.zenith);
  bytes.value(scene.sky.horizon);
  bytes.value(scene.sky.ground);
  bytes.value(scene.bounds.min);
  bytes.value(scene.bounds.max);
  for (auto* lines :
       {&scene.report.found, &scene.report.dropped, &scene.report.ignored, &scene.report.guessed})
    list(bytes, *lines);
  bytes.value(scene.report.metresPerUnit);
}

/// What the Scene type promises, for a file whose checksum may have been forged.
bool keepsPromises(const Scene& scene) {
  const auto sound = [&](const TextureUse& use) {
    return use.texture >= -1 && use.texture < int(scene.textures.size());
  };
  for (const Material& m : scene.materials)
    if (!sound(m.baseColourTexture) || !sound(m.emissiveTexture) || !sound(m.metallicRoughnessTexture) ||
        !sound(m.normalTexture))
      return false;
  for (const Texture& t : scene.textures)
    if (t.image < -1 || t.image >= int(scene.images.size())) return false;
  for (const auto& image : scene.images)
    if (!image) return false;
  const auto isSound = [&](const Mesh& m) {
    const std::size_t n = m.positions.size();
    const auto fits = [&](const auto& array, bool optional) {
      return array.size() == n || (optional && array.empty());
    };
    return m.material >= 0 && m.material < int(scene.materials.size()) && fits(m.normals, false) &&
           fits(m.tangents, true) && fits(m.uv[0], true) && fits(m.uv[1], true) && fits(m.colours, true) &&
           std::ranges::all_of(m.triangles, [n](const glm::uvec3& t) {
             return std::max({t.x, t.y, t.z}) < n;
           });
  };
  if (!std::ranges::all_of(scene.meshes, isSound) || !std::ranges::all_of(scene.prototypes, isSound))
    return false;
  if (scene.instances.size() > kMaxInstances) return false;
  for (const Instance& i : scene.instances)
    if (i.prototype >= scene.prototypes.size() || !isPlacement(i.worldFromPrototype)) return false;
  if (!(scene.report.metresPerUnit > 0 && std::isfinite(scene.report.metresPerUnit))) return false;
  return scene.triangleCount() <= std::numeric_limits<std::uint32_t>::max();
}

tl::unexpected<Error> malformed(const char* message, const std::filesystem::path& path) {
  return fail(ErrorKind::malformed, message, path.string());
}

using File = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;

std::vector<std::byte> bytesOf(const Header& header) {
  std::vector<std::byte> bytes;
  ByteWriter out(
      [&](std::span<const std::byte> part) { bytes.insert(bytes.end(), part.begin(), part.end()); });
  out.value(kMagic);
  fields(out, header);
  return bytes;
}

template <class Write>
std::uint64_t sizeOf(const Write& write) {
  std::uint64_t size = 0;
  SceneWriter counter([&](std::span<const std::byte> part) { size += part.size(); });
  write(counter);
  return size;
}

/// Calls `each` for all arrays of vertices and triangles, in the order of the file.
template <class Visit>
void forEachArray(const Scene& scene, const Visit& each) {
  for (const auto* meshes : {&scene.meshes, &scene.prototypes})
    for (const Mesh& mesh : *meshes) forEachArray(mesh, each);
}

std::uint64_t geometryBytesOf(const Scene& scene) {
  std::uint64_t bytes = 0;
  forEachArray(scene,
               [&](const auto& array) { bytes += withPadding(std::as_bytes(std::span(array)).size()); });
  return bytes;
}

void writeGeometry(HashedOutput& out, const Scene& scene) {
  constexpr std::array<std::byte, kAlignment + MeshArray<std::byte>::kPadding> kZeros{};
  out.write(std::span(kZeros).first(aligned(kHeaderBytes + out.written()) - kHeaderBytes - out.written()));
  forEachArray(scene, [&](const auto& array) {
    const auto bytes = std::as_bytes(std::span(array));
    out.write(bytes);
    out.write(std::span(kZeros).first(withPadding(bytes.size()) - bytes.size()));
  });
}

ByteReader readerOf(std::span<const std::byte> bytes) {
  return {[left = bytes](std::span<std::byte> out) mutable {
            if (out.size() > left.size()) return false;
            std::ranges::copy(left.first(out.size()), out.begin());
            left = left.subspan(out.size());
            return true;
          },
          bytes.size()};
}

}  // namespace

Status writeSceneFile(const SceneFile& file, const std::filesystem::path& path) try {
  const auto writeScene = [&](SceneWriter& out) { fields(out, file.scene); };
  const auto writeDependencies = [&](ByteWriter& out) { list(out, file.dependencies); };
  Header header;
  header.dependencyBytes = sizeOf(writeDependencies);
  header.unpackedBytes = sizeOf(writeScene);
  header.geometryBytes = geometryBytesOf(file.scene);
  return replaceFileAtomically(path, [&](const std::filesystem::path& temporary) -> Status {
    const File stream(std::fopen(temporary.c_str(), "wb"), &std::fclose);
    const auto failed = [&] {
      return fail(errno == ENOSPC || errno == EDQUOT ? ErrorKind::outOfSpace : ErrorKind::unreadable,
                  fmt::format("writing failed: {}", std::strerror(errno)), path.string());
    };
    if (!stream) return failed();
    std::vector<std::byte> head = bytesOf(header);  // as yet without checksum and packed size
    if (std::fwrite(head.data(), 1, head.size(), stream.get()) != head.size()) return failed();
    HashedOutput out(stream.get());
    ByteWriter dependencies([&](std::span<const std::byte> bytes) { out.write(bytes); });
    writeDependencies(dependencies);
    Packer packer(out, header.unpackedBytes);
    SceneWriter scene([&](std::span<const std::byte> bytes) { packer.add(bytes); });
    writeScene(scene);
    if (const char* trouble = packer.close())
      return fail(ErrorKind::internal, fmt::format("packing failed: {}", trouble), path.string());
    header.packedBytes = out.written() - header.dependencyBytes;
    writeGeometry(out, file.scene);
    header.checksum = checksumOf(header, out.hasher());
    head = bytesOf(header);
    if (!out.sound() || std::fseek(stream.get(), 0, SEEK_SET) != 0 ||
        std::fwrite(head.data(), 1, head.size(), stream.get()) != head.size() ||
        std::fflush(stream.get()) != 0)
      return failed();
    return {};
  });
} catch (const std::bad_alloc&) {
  return fail(ErrorKind::outOfSpace, "there is not enough memory to write the scene", path.string());
}

Result<SceneFile> readSceneFile(const std::filesystem::path& path,
                                const std::function<bool(const std::vector<Dependency>&)>& accept) try {
  const auto file = MappedFile::open(path);
  if (!file) return tl::unexpected(file.error());
  const std::span<const std::byte> bytes = (*file)->bytes();
  Header header;
  std::array<char, sizeof kMagic> magic{};
  ByteReader in = readerOf(bytes);
  in.value(magic);
  fields(in, header);
  if (!in.sound() || !std::ranges::equal(magic, kMagic)) return malformed("is not a scene file", path);
  if (header.version != kSceneFileVersion || header.zero != 0)
    return fail(ErrorKind::unsupported,
                fmt::format("is version {} of the scene file; this program reads version {}", header.version,
                            kSceneFileVersion),
                path.string());
  const std::uint64_t size = bytes.size();
  if (std::max({header.dependencyBytes, header.packedBytes, header.geometryBytes}) > size ||
      header.geometryStart() + header.geometryBytes != size)
    return malformed("is cut off or too long", path);
  if (header.unpackedBytes > kMaxUnpacked) return malformed("has a broken size", path);
  Hasher hasher;
  hasher.bytes(bytes.data() + kHeaderBytes, size - kHeaderBytes);
  if (checksumOf(header, hasher) != header.checksum)
    return malformed("is damaged: its checksum is wrong", path);

  SceneFile out;
  ByteReader dependencies = readerOf(bytes.subspan(kHeaderBytes, header.dependencyBytes));
  list(dependencies, out.dependencies);
  if (!dependencies.sound() || !dependencies.atEnd()) return malformed("has a broken list of files", path);
  if (accept && !accept(out.dependencies)) return out;

  Unpacker unpacker(bytes.subspan(kHeaderBytes + header.dependencyBytes, header.packedBytes));
  SceneReader scene([&](std::span<std::byte> part) { return unpacker.read(part); }, header.unpackedBytes,
                    *file, header.geometryStart(), header.geometryBytes);
  fields(scene, out.scene);
  if (!scene.sound() || !scene.atEnd() || !unpacker.atEnd() || !keepsPromises(out.scene))
    return malformed("has broken contents", path);
  return out;
} catch (const std::bad_alloc&) {
  return fail(ErrorKind::outOfSpace, "the scene does not fit in memory", path.string());
}

Status writeSceneFile(const Scene& scene, const std::filesystem::path& path) {
  return writeSceneFile(SceneFile{scene, {}}, path);
}

Result<Scene> readSceneFile(const std::filesystem::path& path) {
  auto file = readSceneFile(path, nullptr);
  if (!file) return tl::unexpected(file.error());
  return std::move(file->scene);
}

}  // namespace acentric
