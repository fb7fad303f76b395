#ifndef STRIDE_COMPILER_IMPORT_MODEL_HPP
#define STRIDE_COMPILER_IMPORT_MODEL_HPP
// What readers of other tools' project files find, whatever the format.

#include <string>
#include <vector>

namespace stc::import {

/// Where something stands in an imported file.
struct Origin {
  std::string file;
  size_t line = 1; ///< from 1
};

/// A line of the report about something that was changed or left out.
struct Remark {
  Origin origin;
  std::string object; ///< its kind and name, as in the file
  std::string text;   ///< what was done, and why
};

/// What a piece of source text declares.
enum class ObjectKind { Pou, Type, GlobalList };

/// Source text of a declaration with its body, in ST (or IL, or textual SFC).
struct Object {
  ObjectKind kind = ObjectKind::Pou;
  std::string name;                ///< of the POU, the type or the list
  std::vector<std::string> folder; ///< names from the outermost one
  std::string text;                ///< complete, in UTF-8, lines end with \n
  Origin origin;
};

/// A task; texts as the file has them.
struct Task {
  std::string name;
  std::string priority; ///< number; empty: not given
  std::string interval; ///< TIME literal; empty: none
  std::string event;    ///< BOOL expression; empty: none
  std::vector<std::string> programs;
  Origin origin;
};

/// A library that the project refers to.
struct LibraryReference {
  std::string name;
  std::string version; ///< empty: not given
  Origin origin;
};

/// Text of a section that is not imported; it is kept beside the report.
struct KeptText {
  std::string path; ///< relative to the folder of kept texts, with `/`
  std::string text;
};

/// All files of one import.
struct Model {
  std::vector<Object> objects;
  std::vector<Task> tasks;
  std::vector<LibraryReference> libraries;
  std::vector<KeptText> kept;
  std::vector<Remark> changed;
  std::vector<Remark> leftOut; ///< losses
};

} // namespace stc::import

#endif // STRIDE_COMPILER_IMPORT_MODEL_HPP
