#include "compiler/import/reader.hpp"

#include "compiler/import/codesys_export_reader.hpp"
#include "compiler/import/exp_reader.hpp"
#include "compiler/import/plcopen_reader.hpp"
#include "compiler/import/scl_reader.hpp"
#include "compiler/import/twincat_reader.hpp"
#include "runtime/common/text.hpp"

#include <algorithm>
#include <array>

#include <fmt/format.h>

namespace stc::import {

namespace {

/// What the beginning of a file must show; formats that begin with a licence are found as well.
constexpr size_t kSniffed = 65536;

bool isExp(std::string_view text) {
  constexpr std::array<std::string_view, 5> kSigns = {"(* @NESTEDCOMMENTS", "(* @PATH",
                                                      "(* @OBJECTFLAGS", "(* @GLOBAL_VARIABLE_LIST",
                                                      "(* @END_DECLARATION"};
  return std::any_of(kSigns.begin(), kSigns.end(), [&](std::string_view sign) {
    return text.find(sign) != std::string_view::npos;
  });
}

constexpr std::string_view kTwinCatFiles =
    ".tcpou .tcdut .tcgvl .tcio .tctto .plcproj .tsproj .xti .tcvis .tcvmo .tctlo .tcgtlo .tcipo";

// A format is added here.
constexpr std::array<Format, 5> kFormats = {{
    {"CoDeSys V2.3 export", ".exp", isExp, readExp},
    {"PLCopen XML", ".xml", isPlcOpen, readPlcOpen},
    {"TwinCAT 3", kTwinCatFiles, isTwinCat, readTwinCat},
    {"CODESYS V3 export", ".export", isCodesysExport, readCodesysExport},
    {"Siemens SCL", ".scl .udt .db", isScl, readScl},
}};

/// Files of project tools that hold no text to read.
struct Refusal {
  std::string_view extensions;
  std::string_view magic; ///< first bytes; empty: any
  std::string_view why;
};

constexpr std::string_view kExportFromV23 =
    "it is a binary project of CoDeSys V2.3: open it there and use Project > Export, which writes "
    "an .EXP";
constexpr std::string_view kExportFromV3 =
    "it is a binary project of CODESYS V3: open it there and use Project > Export PLCopenXML";

constexpr std::array<Refusal, 9> kRefusals = {{
    {".pro", "CoDeSys+", kExportFromV23},
    {".pro .lib", "", kExportFromV23},
    {".project .library .projectarchive", "", kExportFromV3},
    {".compiled-library .compiled-library-v3", "",
     "it is a compiled library; its sources are not in it"},
    {".tpy", "",
     "it is a symbol description of TwinCAT 2, without sources: export the project as .EXP"},
    {".tsm", "", "it is a System Manager project of TwinCAT 2: only its PLC project is imported"},
    {".tnzip .tszip .zip", "", "it is an archive: unpack it and name the folder"},
    {".awl", "", "Step 7 instruction lists are not imported: generate SCL sources"},
    {".ap13 .ap14 .ap15 .ap16 .ap17 .ap18 .ap19 .s7p", "",
     "it is a binary project of Siemens: generate SCL sources from its blocks"},
}};

std::string extensionOf(std::string_view file) {
  const size_t slash = file.find_last_of('/');
  const std::string_view name = slash == std::string_view::npos ? file : file.substr(slash + 1);
  const size_t dot = name.find_last_of('.');
  return dot == std::string_view::npos ? std::string()
                                       : stride::common::lowerCase(name.substr(dot));
}

bool lists(std::string_view extensions, std::string_view extension) {
  while (!extensions.empty()) {
    const size_t end = std::min(extensions.find(' '), extensions.size());
    if (extensions.substr(0, end) == extension)
      return true;
    extensions.remove_prefix(std::min(end + 1, extensions.size()));
  }
  return false;
}

std::string knownFormats() {
  std::string names;
  for (const Format &each : kFormats)
    names += fmt::format("{}{} ({})", names.empty() ? "" : ", ", each.name, each.extensions);
  return names;
}

} // namespace

std::span<const Format> formats() { return kFormats; }

bool hasKnownExtension(std::string_view file) {
  const std::string extension = extensionOf(file);
  return std::any_of(kFormats.begin(), kFormats.end(),
                     [&](const Format &each) { return lists(each.extensions, extension); });
}

FormatChoice formatOf(std::string_view file, std::string_view text) {
  const std::string extension = extensionOf(file);
  for (const Refusal &each : kRefusals)
    if (lists(each.extensions, extension) && text.starts_with(each.magic))
      return {nullptr, std::string(each.why), true};
  text = text.substr(0, kSniffed);
  const Format *byName = nullptr;
  size_t namesakes = 0;
  for (const Format &each : kFormats)
    if (lists(each.extensions, extension)) {
      byName = &each;
      ++namesakes;
      if (each.matches(text))
        return {&each, {}, true};
    }
  if (namesakes == 1)
    return {byName, {}, true};
  for (const Format &each : kFormats)
    if (each.matches(text))
      return {&each, {}, true};
  return {nullptr, fmt::format("its format is not known; known are {}", knownFormats()), false};
}

} // namespace stc::import
