#pragma once
/// The program's texts in the language that was chosen. The English text in the source is the key: what no
/// catalogue translates is shown in English. Looking up is safe from any thread; a text that was handed out
/// stays where it is until the program ends, also when the language changes.

#include <fmt/format.h>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <tl/expected.hpp>

namespace acentric {

/// The text in the language that is in force.
const char* tr(const char* english);
std::string tr(const std::string& english);
/// The same for an English word that means two things: `context` tells translators which.
const char* trIn(const char* context, const char* english);
/// A text that is used as a pattern of printf: in English where the translated one takes other values.
const char* trPrintf(const char* english);
/// Marks a text of a table, which is translated by tr() where it is shown.
constexpr const char* trLater(const char* english) { return english; }
constexpr const char* trLaterIn(const char*, const char* english) { return english; }

/// As above from a pattern of fmt; in English where the translated pattern does not fit the values.
std::string translated(const char* english, fmt::format_args values);
std::string translated(const char* one, const char* many, std::uint64_t count, fmt::format_args values);

template <class... Values>
std::string trf(fmt::format_string<Values...> english, Values&&... values) {
  return translated(fmt::string_view(english).data(), fmt::make_format_args(values...));
}
/// In the form that the language has for `count`, which is among the values if it is shown.
template <class... Values>
std::string trfMany(fmt::format_string<Values...> one, fmt::format_string<Values...> many,
                    std::uint64_t count, Values&&... values) {
  return translated(fmt::string_view(one).data(), fmt::string_view(many).data(), count,
                    fmt::make_format_args(values...));
}

struct Language {
  const char* code;  ///< ISO 639-1: the catalogue is CODE/LC_MESSAGES/acentric.mo
  const char* name;  ///< in its own script
};
/// English first.
std::span<const Language> languages();
bool isLanguage(std::string_view code);

/// The code of the language that the environment asks for: of LANGUAGE's list the first that there is, else
/// by LC_ALL, LC_MESSAGES or LANG, whichever is set first; "en" for the locales C and POSIX and for what
/// there is not. `variable` gives the value of one, or null.
std::string systemLanguage(const std::function<const char*(const char*)>& variable);
std::string systemLanguage();

/// Where the catalogues of this program lie: share/locale beside the folder of the program.
std::filesystem::path catalogueFolder();
/// From now on texts are in this language; to be called by the main thread. The error is one line for a
/// person; texts are in English then.
tl::expected<void, std::string> setLanguage(const std::string& code,
                                            const std::filesystem::path& folder = catalogueFolder());
/// The code of the one in force.
std::string language();
/// All texts of its catalogue after each other: which letters have to be shown.
std::string catalogueTexts();

}  // namespace acentric
