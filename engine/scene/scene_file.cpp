#include "engine/scene/scene_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
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
  std::uint32_t version = kSceneFileVersion;
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

void write(ByteWriter& out, const TextureUse& use) {
  out.value(std::int32_t(use.texture));
  out.value(use.uvSet);
  out.value(use.transform);
}

void read(ByteReader& in, TextureUse& use) {
  std::int32_t texture = 0;
  in.value(texture);
  use.texture = texture;
  in.small(use.uvSet, 1);
  in.value(use.transform);
}

void write(ByteWriter& out, const Material& m) {
  out.text(m.name);
  out.value(m.baseColour);
  write(out, m.baseColourTexture);
  out.value(m.emissive);
  write(out, m.emissiveTexture);
  out.value(m.metallic);
  out.value(m.roughness);
  write(out, m.metallicRoughnessTexture);
  write(out, m.normalTexture);
  out.value(m.normalScale);
  out.value(m.transmission);
  out.value(m.alphaMode);
  out.value(m.alphaCutoff);
  out.flag(m.doubleSided);
  out.flag(m.unlit);
}

void read(ByteReader& in, Material& m) {
  in.text(m.name);
  in.value(m.baseColour);
  read(in, m.baseColourTexture);
  in.value(m.emissive);
  read(in, m.emissiveTexture);
  in.value(m.metallic);
  in.value(m.roughness);
  read(in, m.metallicRoughnessTexture);
  read(in, m.normalTexture);
  in.value(m.normalScale);
  in.value(m.transmission);
  in.small(m.alphaMode, 2);
  in.value(m.alphaCutoff);
  in.small(m.doubleSided, 1);
  in.small(m.unlit, 1);
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

void write(ByteWriter& out, const Mesh& m) {
  out.text(m.name);
  out.value(std::int32_t(m.material));
  forEachArray(m, [&](const auto& array) { out.value(std::uint64_t(array.size())); });
}

/// Takes the lengths of arrays from the scene and their contents from the geometry, one behind the other.
class GeometryReader {
 public:
  GeometryReader(std::shared_ptr<const MappedFile> file, std::uint64_t start, std::uint64_t bytes)
      : file_(std::move(file)), left_(file_->bytes().subspan(start, bytes)) {}

  void read(ByteReader& in, Mesh& m) {
    in.text(m.name);
    std::int32_t material = 0;
    in.value(material);
    m.material = material;
    forEachArray(m, [&]<class T>(MeshArray<T>& array) {
      std::uint64_t size = 0;
      in.value(size);
      if (size > left_.size() / sizeof(T) || withPadding(size * sizeof(T)) > left_.size()) in.refuse();
      if (!in.sound() || size == 0) return;
      array = MeshArray<T>::mapped({reinterpret_cast<const T*>(left_.data()), std::size_t(size)}, file_);
      left_ = left_.subspan(withPadding(size * sizeof(T)));
    });
  }
  bool atEnd() const { return left_.empty(); }

 private:
  std::shared_ptr<const MappedFile> file_;
  std::span<const std::byte> left_;
};

void write(ByteWriter& out, const Instance& i) {
  out.value(i.prototype);
  out.value(i.worldFromPrototype);
}

void read(ByteReader& in, Instance& i) {
  in.value(i.prototype);
  in.value(i.worldFromPrototype);
}

void write(ByteWriter& out, const Texture& t) {
  out.text(t.name);
  out.value(std::int32_t(t.image));
  out.value(t.wrapU);
  out.value(t.wrapV);
  out.flag(t.nearest);
}

void read(ByteReader& in, Texture& t) {
  in.text(t.name);
  std::int32_t image = 0;
  in.value(image);
  t.image = image;
  in.small(t.wrapU, 2);
  in.small(t.wrapV, 2);
  in.small(t.nearest, 1);
}

void write(ByteWriter& out, const std::shared_ptr<const ColourImage>& image) {
  static const ColourImage kNone;
  const ColourImage& picture = image ? *image : kNone;
  out.value(std::int32_t(picture.width));
  out.value(std::int32_t(picture.height));
  out.array(picture.pixels);
}

void read(ByteReader& in, std::shared_ptr<const ColourImage>& image) {
  ColourImage picture;
  std::int32_t width = 0, height = 0;
  in.value(width);
  in.value(height);
  in.array(picture.pixels);
  const bool fits =
      width > 0 && height > 0 && std::size_t(width) * std::size_t(height) == picture.pixels.size();
  if (fits) {
    picture.width = width;
    picture.height = height;
    image = std::make_shared<const ColourImage>(std::move(picture));
  }
}

void write(ByteWriter& out, const Light& l) {
  out.text(l.name);
  out.value(l.kind);
  out.value(l.colour);
  out.value(l.intensity);
  out.value(l.position);
  out.value(l.direction);
  out.value(l.range);
  out.value(l.innerCone);
  out.value(l.outerCone);
  out.value(l.radius);
  out.value(l.angularRadius);
}

void read(ByteReader& in, Light& l) {
  in.text(l.name);
  in.small(l.kind, 2);
  in.value(l.colour);
  in.value(l.intensity);
  in.value(l.position);
  in.value(l.direction);
  in.value(l.range);
  in.value(l.innerCone);
  in.value(l.outerCone);
  in.value(l.radius);
  in.value(l.angularRadius);
}

void write(ByteWriter& out, const std::string& line) { out.text(line); }
void read(ByteReader& in, std::string& line) { in.text(line); }

void write(ByteWriter& out, const Dependency& d) {
  out.text(d.path);
  out.flag(d.exists);
  out.value(d.size);
  out.value(d.modifiedNanoseconds);
  out.value(d.inode);
  out.value(d.content);
}

void read(ByteReader& in, Dependency& d) {
  in.text(d.path);
  in.small(d.exists, 1);
  in.value(d.size);
  in.value(d.modifiedNanoseconds);
  in.value(d.inode);
  in.value(d.content);
}

template <class T>
void writeAll(ByteWriter& out, const std::vector<T>& things) {
  out.value(std::uint64_t(things.size()));
  for (const T& thing : things) write(out, thing);
}

template <class T, class Read>
void readAll(ByteReader& in, std::vector<T>& things, const Read& readOne) {
  const std::size_t count = in.length(8);
  for (std::size_t i = 0; i < count && in.sound(); ++i) readOne(things.emplace_back());
}
template <class T>
void readAll(ByteReader& in, std::vector<T>& things) {
  readAll(in, things, [&](T& thing) { read(in, thing); });
}

void write(ByteWriter& out, const Scene& scene) {
  out.text(scene.name);
  out.value(scene.key);
  out.value(scene.parts);
  out.value(scene.origin);
  writeAll(out, scene.materials);
  writeAll(out, scene.meshes);
  writeAll(out, scene.prototypes);
  writeAll(out, scene.instances);
  writeAll(out, scene.textures);
  writeAll(out, scene.images);
  writeAll(out, scene.lights);
  out.value(scene.sky.zenith);
  out.value(scene.sky.horizon);
  out.value(scene.sky.ground);
  out.value(scene.bounds.min);
  out.value(scene.bounds.max);
  for (const auto* lines :
       {&scene.report.found, &scene.report.dropped, &scene.report.ignored, &scene.report.guessed})
    writeAll(out, *lines);
  out.value(scene.report.metresPerUnit);
}

void read(ByteReader& in, GeometryReader& geometry, Scene& scene) {
  const auto readMesh = [&](Mesh& mesh) { geometry.read(in, mesh); };
  in.text(scene.name);
  in.value(scene.key);
  in.value(scene.parts);
  in.value(scene.origin);
  readAll(in, scene.materials);
  readAll(in, scene.meshes, readMesh);
  readAll(in, scene.prototypes, readMesh);
  readAll(in, scene.instances);
  readAll(in, scene.textures);
  readAll(in, scene.images);
  readAll(in, scene.lights);
  in.value(scene.sky.zenith);
  in.value(scene.sky.horizon);
  in.value(scene.sky.ground);
  in.value(scene.bounds.min);
  in.value(scene.bounds.max);
  for (auto* lines :
       {&scene.report.found, &scene.report.dropped, &scene.report.ignored, &scene.report.guessed})
    readAll(in, *lines);
  in.value(scene.report.metresPerUnit);
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
  out.value(header.version);
  out.value(std::uint32_t(0));
  out.value(header.dependencyBytes);
  out.value(header.packedBytes);
  out.value(header.unpackedBytes);
  out.value(header.geometryBytes);
  out.value(header.checksum);
  return bytes;
}

template <class Write>
std::uint64_t sizeOf(const Write& write) {
  std::uint64_t size = 0;
  ByteWriter counter([&](std::span<const std::byte> part) { size += part.size(); });
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
  const auto writeScene = [&](ByteWriter& out) { write(out, file.scene); };
  const auto writeDependencies = [&](ByteWriter& out) { writeAll(out, file.dependencies); };
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
    ByteWriter scene([&](std::span<const std::byte> bytes) { packer.add(bytes); });
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
  std::uint32_t zero = 0;
  ByteReader in = readerOf(bytes);
  in.value(magic);
  in.value(header.version);
  in.value(zero);
  in.value(header.dependencyBytes);
  in.value(header.packedBytes);
  in.value(header.unpackedBytes);
  in.value(header.geometryBytes);
  in.value(header.checksum);
  if (!in.sound() || !std::ranges::equal(magic, kMagic)) return malformed("is not a scene file", path);
  if (header.version != kSceneFileVersion || zero != 0)
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
  readAll(dependencies, out.dependencies);
  if (!dependencies.sound() || !dependencies.atEnd()) return malformed("has a broken list of files", path);
  if (accept && !accept(out.dependencies)) return out;

  Unpacker unpacker(bytes.subspan(kHeaderBytes + header.dependencyBytes, header.packedBytes));
  ByteReader scene([&](std::span<std::byte> part) { return unpacker.read(part); }, header.unpackedBytes);
  GeometryReader geometry(*file, header.geometryStart(), header.geometryBytes);
  read(scene, geometry, out.scene);
  if (!scene.sound() || !scene.atEnd() || !unpacker.atEnd() || !geometry.atEnd() || !keepsPromises(out.scene))
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
