#ifndef STRIDE_COMPILER_SOURCE_SOURCES_HPP
#define STRIDE_COMPILER_SOURCE_SOURCES_HPP
// The texts of one compilation: files of the disk, what an editor has not saved, what Stride
// writes.

#include "compiler/source/overlay.hpp"
#include "compiler/source/read_source.hpp"
#include "compiler/source/span.hpp"
#include "compiler/source/synthetic_source.hpp"

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace stc {

/// One source text. The text is UTF-8 whatever the file's encoding was (Latin-1 is converted, a BOM
/// is dropped).
class SourceFile {
public:
  SourceFile(FileId id, std::string name, std::string text);

  [[nodiscard]] FileId id() const { return id_; }
  /// The name as diagnostics show it: a path relative to the project, `<stdlib>/…` for library
  /// files.
  [[nodiscard]] const std::string &name() const { return name_; }
  /// The name as generated code carries it, which does not depend on where the project lies: of a
  /// single file its name without folders.
  [[nodiscard]] const std::string &codeName() const {
    return codeName_.empty() ? name_ : codeName_;
  }
  void setCodeName(std::string name) { codeName_ = std::move(name); }
  [[nodiscard]] std::string_view text() const { return text_; }
  /// Stride has written it; see Sources::origin().
  [[nodiscard]] bool isSynthetic() const { return synthetic_; }
  [[nodiscard]] LineColumn position(uint32_t offset) const;
  /// 1-based number of the line in which the byte lies.
  [[nodiscard]] uint32_t lineNumber(uint32_t offset) const;
  /// Offset of the first byte of the 1-based line.
  [[nodiscard]] uint32_t lineStart(uint32_t number) const { return lineStarts_[number - 1]; }
  /// Text of the 1-based line, without its line end.
  [[nodiscard]] std::string_view line(uint32_t number) const;
  [[nodiscard]] uint32_t lineCount() const { return static_cast<uint32_t>(lineStarts_.size()); }

private:
  friend class Sources;
  FileId id_;
  std::string name_;
  std::string codeName_; ///< empty: name_
  std::string text_;
  std::vector<uint32_t> lineStarts_;
  std::vector<SyntheticSource::Part> parts_; ///< of a synthetic text
  bool synthetic_ = false;
  bool ascii_ = true; ///< every character is one byte
};

/// Owns all source texts; addresses of files stay valid for its lifetime. Every file that a
/// compilation reads comes through here.
class Sources {
public:
  Sources() = default;
  /// `overlay` goes before the disk, and must outlive this; null: there is none.
  explicit Sources(const Overlay *overlay) : overlay_(overlay) {}

  /// Adds a text that is already UTF-8 (library text, generated declarations, tests).
  FileId add(std::string name, std::string text);
  /// Adds raw file bytes: drops a BOM, converts Latin-1 to UTF-8 when the bytes are not valid
  /// UTF-8.
  FileId addBytes(std::string name, std::string bytes);
  /// Adds a text that Stride has written.
  FileId add(const SyntheticSource &source);
  /// The bytes of a file; nullopt when it cannot be read (readSourceError() tells why).
  [[nodiscard]] std::optional<std::string> read(const std::filesystem::path &path,
                                                size_t most = kMaxSourceBytes) const;
  /// Reads a file of at most `most` bytes; nullopt when it cannot be read (readSourceError() tells
  /// why).
  std::optional<FileId> load(const std::filesystem::path &path, std::string name,
                             size_t most = kMaxSourceBytes);

  [[nodiscard]] const SourceFile &file(FileId id) const { return *files_[id - 1]; }
  [[nodiscard]] SourceFile &file(FileId id) { return *files_[id - 1]; }
  [[nodiscard]] std::string_view text(Span span) const;
  [[nodiscard]] LineColumn position(Span span) const;
  /// The place for which a place in a synthetic text stands, perhaps none; others stand for
  /// themselves.
  [[nodiscard]] Span origin(Span span) const;
  [[nodiscard]] size_t size() const { return files_.size(); }

  /// Whether the overlay has the file.
  [[nodiscard]] bool isUnsaved(const std::filesystem::path &path) const {
    return overlay_ != nullptr && overlay_->find(path) != nullptr;
  }
  /// The overlay's files below a folder.
  [[nodiscard]] std::vector<std::filesystem::path>
  unsavedBelow(const std::filesystem::path &folder) const {
    return overlay_ != nullptr ? overlay_->filesBelow(folder)
                               : std::vector<std::filesystem::path>();
  }

private:
  const Overlay *overlay_ = nullptr;
  std::vector<std::unique_ptr<SourceFile>> files_;
};

} // namespace stc

#endif // STRIDE_COMPILER_SOURCE_SOURCES_HPP
