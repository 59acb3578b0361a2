# cmake -DOUT=file.cpp -DFILES="a;b" -DHEADER=folder/shader_sources.h -DSPACE=namespace -P embed.cmake : writes the files as
# string literals; the header declares how they are found.
set(entries "")
foreach(file ${FILES})
  get_filename_component(name ${file} NAME)
  file(READ ${file} text)
  string(FIND "${text}" ")glsl\"" clash)
  if(NOT clash EQUAL -1)
    message(FATAL_ERROR "${file}: holds the delimiter of the string literal")
  endif()
  string(APPEND entries "    {\"${name}\", R\"glsl(${text})glsl\"},\n")
endforeach()
file(CONFIGURE OUTPUT ${OUT} @ONLY CONTENT [=[// Made by shaders/embed.cmake.
#include "@HEADER@"

namespace @SPACE@ {
namespace {
constexpr ShaderSource kSources[] = {
@entries@};
}  // namespace
std::span<const ShaderSource> shaderSources() { return kSources; }
}  // namespace @SPACE@
]=])
