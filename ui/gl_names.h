#pragma once
/// OpenGL names that delete themselves, and a shader program from the embedded files. Made and destroyed with
/// the window's context current.

#include <string>
#include <utility>

namespace acentric::ui {

enum class GlKind { buffer, texture, vertexArray, program, renderbuffer, framebuffer };

/// Move only; 0 = none.
template <GlKind kind>
class GlName {
 public:
  GlName() = default;
  explicit GlName(unsigned name) : name_(name) {}
  ~GlName() { reset(); }
  GlName(GlName&& other) noexcept : name_(std::exchange(other.name_, 0)) {}
  GlName& operator=(GlName&& other) noexcept {
    if (this != &other) {
      reset();
      name_ = std::exchange(other.name_, 0);
    }
    return *this;
  }
  GlName(const GlName&) = delete;
  GlName& operator=(const GlName&) = delete;

  /// Made when first asked for.
  unsigned made();
  unsigned name() const { return name_; }
  void reset();

 private:
  unsigned name_ = 0;
};

/// Compiles `vertexFile` (canvas.glsl before it) and `fragmentFile` when first used.
class GlProgram {
 public:
  GlProgram(const char* vertexFile, const char* fragmentFile) : files_{vertexFile, fragmentFile} {}
  /// False, with the reason in problem(), if this OpenGL cannot compile it.
  bool use();
  const std::string& problem() const { return problem_; }
  void set(const char* uniform, int value) const;
  void set(const char* uniform, float value) const;
  void set(const char* uniform, float x, float y) const;
  void set(const char* uniform, float x, float y, float z, float w) const;
  int location(const char* uniform) const;

 private:
  void compile();
  std::pair<const char*, const char*> files_;
  GlName<GlKind::program> program_;
  std::string problem_;
};

}  // namespace acentric::ui
