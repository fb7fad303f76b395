#include "compiler/project/library_index.hpp"

#include "compiler/syntax/st_text.hpp"

#include <algorithm>

namespace stc {

/// Whether the library's names need its name in front: they are words that programs use themselves
/// (Line, SIZE). As in SoftMotion 3 and CODESYS V3.
static bool isQualifiedOnly(const EmbeddedFile &file) {
  static constexpr std::string_view kLibraries[] = {"SM3_CamBuilder", "CAA_Types", "CAA_Memory",
                                                    "Tc2_MC2"};
  return std::ranges::find(kLibraries, file.library) != std::end(kLibraries);
}

/// Whether the library is there so that programs of CODESYS V3 or TwinCAT 3 find what they use.
static bool isForeign(const EmbeddedFile &file) {
  static constexpr std::string_view kForeign[] = {
      "CAA_Memory", "CAA_Types", "Standard64", "StringUtils", "SysTime",
      "SysTypes",   "Tc2_MC2",   "Tc2_Math",   "Tc2_System",  "Tc2_Utilities"};
  return std::find(std::begin(kForeign), std::end(kForeign), file.library) != std::end(kForeign);
}

static LibraryIndex::Entry entryOf(const EmbeddedFile &file) {
  return {file.library, file.fileName, file.text, isQualifiedOnly(file), isForeign(file)};
}

std::vector<LibraryIndex::Entry> EmbeddedLibraryIndex::find(std::string_view lowerName) const {
  std::vector<Entry> result;
  auto at = std::lower_bound(
      tables_.names.begin(), tables_.names.end(), lowerName,
      [](const EmbeddedName &name, std::string_view word) { return name.lower < word; });
  for (; at != tables_.names.end() && at->lower == lowerName; ++at) {
    const EmbeddedFile &file = tables_.files[at->file];
    const bool known = std::any_of(result.begin(), result.end(), [&](const Entry &entry) {
      return entry.library == file.library;
    });
    if (!known)
      result.push_back(entryOf(file));
  }
  return result;
}

bool EmbeddedLibraryIndex::isLibrary(std::string_view lowerName) const {
  return std::any_of(tables_.files.begin(), tables_.files.end(),
                     [&](const EmbeddedFile &file) { return answersTo(file.library, lowerName); });
}

namespace {

struct OtherName {
  std::string_view lowerName;
  std::string_view library;
};

constexpr OtherName kSoftMotion3[] = {
    {"sm3_basic", "SM_DriveBasic"},
    {"sm3_basic", "SM_PLCopen"},
    {"sm3_basic", "SM_FileFBs"},
    {"sm3_cnc", "SM_CNC"},
    {"sm3_error", "SM_Error"},
    {"smcb", "SM3_CamBuilder"},
    {"sm3_math", "SM_CNC"},
    {"sm3m", "SM_CNC"},
    {"sm3m", "SM3_Math"},
    {"sm3_transformation", "SM_Trafo"},
    {"trafo", "SM_Trafo"},
    {"trafo", "SM3_Transformation"},
    {"sm3_commonpublic", "SM3_Robotics"},
};

/// Of CODESYS V3 and TwinCAT 3.
constexpr OtherName kForeignNames[] = {
    {"caa", "CAA_Types"},       {"mem", "CAA_Memory"},        {"stu", "StringUtils"},
    {"standard64", "Standard"}, {"tc2_standard", "Standard"}, {"sysmem", "SysLibMem"},
    {"systimecore", "SysTime"}, {"systimertc", "SysTime"},    {"ibaselibrary", "__SYSTEM"},
};

template <size_t Count>
bool isNamed(const OtherName (&names)[Count], std::string_view library,
             std::string_view lowerName) {
  return std::any_of(std::begin(names), std::end(names), [&](const OtherName &other) {
    return other.lowerName == lowerName && other.library == library;
  });
}

} // namespace

bool EmbeddedLibraryIndex::isReserved(std::string_view lowerName) const {
  return std::any_of(tables_.files.begin(), tables_.files.end(), [&](const EmbeddedFile &file) {
    return !isForeign(file) && (equalIgnoringCase(file.library, lowerName) ||
                                isNamed(kSoftMotion3, file.library, lowerName));
  });
}

bool EmbeddedLibraryIndex::answersTo(std::string_view library, std::string_view lowerName) const {
  return equalIgnoringCase(library, lowerName) || isNamed(kSoftMotion3, library, lowerName) ||
         isNamed(kForeignNames, library, lowerName);
}

std::vector<LibraryIndex::Name> EmbeddedLibraryIndex::names() const {
  std::vector<Name> result;
  std::string_view last;
  for (const EmbeddedName &name : tables_.names) {
    if (isQualifiedOnly(tables_.files[name.file]) || last == name.lower)
      continue;
    result.push_back({name.text, name.kind});
    last = name.lower;
  }
  return result;
}

std::vector<LibraryIndex::Entry> EmbeddedLibraryIndex::files(std::string_view library) const {
  std::vector<Entry> result;
  for (const EmbeddedFile &file : tables_.files)
    if (equalIgnoringCase(file.library, library))
      result.push_back(entryOf(file));
  return result;
}

std::vector<std::string_view> EmbeddedLibraryIndex::libraries() const {
  std::vector<std::string_view> result;
  for (const EmbeddedFile &file : tables_.files)
    if (result.empty() || result.back() != file.library)
      result.push_back(file.library);
  return result;
}

} // namespace stc
