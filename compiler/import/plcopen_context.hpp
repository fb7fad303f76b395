#ifndef STRIDE_COMPILER_IMPORT_PLCOPEN_CONTEXT_HPP
#define STRIDE_COMPILER_IMPORT_PLCOPEN_CONTEXT_HPP
// What all parts of the PLCopen XML reader have in common: looking at elements, and the report.
// Internal to compiler/import.

#include "compiler/import/model.hpp"
#include "compiler/import/networks/xml_nodes.hpp"
#include "compiler/import/xml_document.hpp"

#include <initializer_list>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace stc::import::plcopen {

using Node = pugi::xml_node;

/// All child elements, or those of a local name.
[[nodiscard]] std::vector<Node> children(const Node &node, std::string_view name = {});
/// The first child element, whatever its name.
[[nodiscard]] Node firstElement(const Node &node);
/// textOf() without blank lines at the beginning and blanks at the end; lines end with \n.
[[nodiscard]] std::string linesOf(const Node &node);
[[nodiscard]] std::string attribute(const Node &node, const char *name);
/// Letters, digits and `_`, not beginning with a digit.
[[nodiscard]] bool isName(std::string_view text);
/// The words are equal but for the case of ASCII letters.
[[nodiscard]] bool sameName(std::string_view a, std::string_view b);
/// The elements inside of `addData/data`, with the name of their `data`.
struct Extra {
  std::string name; ///< a URI
  Node element;     ///< null: the data is empty
  Node data;
};
[[nodiscard]] std::vector<Extra> extrasOf(const Node &node);
/// The element of this local name in the addData of `node`; null: there is none.
[[nodiscard]] Node extra(const Node &node, std::string_view name);

/// One import: the file, the model, and the report.
class Context {
public:
  Context(const std::string &file, const XmlDocument &document, Model &model)
      : file_(file), document_(document), model_(model) {}

  [[nodiscard]] Model &model() { return model_; }
  [[nodiscard]] Origin originOf(const Node &node) const { return {file_, document_.lineOf(node)}; }
  void changed(const Node &node, std::string object, std::string text);
  void leftOut(const Node &node, std::string object, std::string text);
  /// Reports the child elements that are none of `known`: one line for each kind of element in the
  /// whole file, with their number.
  void leaveOutUnknown(const Node &node, std::initializer_list<std::string_view> known);
  /// The same of what stands in addData; `known` are local names of elements there. Names that
  /// identify things for the tool that wrote the file are left out without a word.
  void leaveOutUnknownExtras(const Node &node, std::initializer_list<std::string_view> known);
  /// Puts the lines about unknown elements into the report.
  void finish();

  /// The attribute `name` when it is one of ST; otherwise it is reported, and empty.
  [[nodiscard]] std::string nameOf(const Node &node, std::string_view kind);

  /// Folder of an object: by the identification in its addData, or by its own name.
  [[nodiscard]] std::vector<std::string> folderOf(const Node &node) const;
  void setFolder(const std::string &id, std::vector<std::string> folder) {
    folders_[id] = std::move(folder);
  }

  void add(ObjectKind kind, const Node &node, std::string name, std::string text);
  /// Adds a type for a structure that a variable declares in line, and gives its name.
  [[nodiscard]] std::string addHelperType(const Node &node, const std::string &owner,
                                          const std::string &text);

private:
  struct Unknown {
    Origin origin;
    size_t count = 0;
  };
  const std::string &file_;
  const XmlDocument &document_;
  Model &model_;
  std::map<std::string, Unknown> unknown_;
  std::map<std::string, std::vector<std::string>> folders_; ///< by identification
  size_t helperTypes_ = 0;
};

// ---- parts of declarations, each as lines of ST

/// `{attribute 'a' := 'b'}` of addData.
[[nodiscard]] std::string attributeLines(const Node &node, const std::string &indent = {});
/// The element `documentation` as `///` lines.
[[nodiscard]] std::string documentationLines(const Node &node, const std::string &indent = {});
[[nodiscard]] std::string commentLines(std::string_view text, const std::string &indent,
                                       std::string_view sign = "///");
/// The declaration as the author has written it (addData interfaceasplaintext); empty: none.
[[nodiscard]] std::string plainDeclaration(const Node &node);

/// `stride export plcopen` keeps the file that the element comes from as a whole.
[[nodiscard]] bool isInSource(const Node &node);

// ---- plcopen_types.cpp

/// A type: `node` has one element, which names or describes it.
[[nodiscard]] std::string typeText(Context &context, const Node &node, const std::string &owner);
/// ` := value` of the element initialValue of `node`; empty: it has none. `type`: for texts that
/// stand without quotes.
[[nodiscard]] std::string initialText(Context &context, const Node &node, std::string_view type);
/// The fields of a structure or union, or the variables of a list.
[[nodiscard]] std::string variableLines(Context &context, const Node &list,
                                        const std::string &owner);
void readDataType(Context &context, const Node &node);
/// A union of CODESYS: `<union name="…">` with variables.
void readUnion(Context &context, const Node &node);

// ---- plcopen_interface.cpp

/// VAR_…, END_VAR of a list of variables; empty: it has no variables.
[[nodiscard]] std::string sectionText(Context &context, const Node &list, std::string_view keyword,
                                      const std::string &owner);
/// All sections of the element `interface` in the order of the file.
[[nodiscard]] std::string sectionsText(Context &context, const Node &interface,
                                       const std::string &owner);
/// The global variables of a list (a resource's, a configuration's, a POU's).
void readGlobals(Context &context, const Node &list, const std::string &fallbackName);

// ---- plcopen_pous.cpp

void readPou(Context &context, const Node &node);
/// An INTERFACE of CODESYS.
void readInterface(Context &context, const Node &node);

// ---- plcopen_body.cpp

/// The statements of an element `body`; what is not imported becomes `{error …}`. `pou` is where
/// its transitions and actions are, or null; actions that the body brings go to `members`.
[[nodiscard]] std::string bodyText(Context &context, const Node &body, const Node &pou,
                                   const std::string &object, std::string &members);
/// Text of a pragma that stops the compiler where a body is missing.
[[nodiscard]] std::string errorPragma(std::string_view why);
/// Reports the members that the chart of a method, an accessor or an action would need.
void leaveOutMembers(Context &context, const Node &node, const std::string &object,
                     const std::string &members);

// ---- plcopen_chart.cpp

/// A sequential function chart as textual SFC.
[[nodiscard]] std::string chartText(Context &context, const Node &sfc, const Node &pou,
                                    const std::string &object, std::string &members);

// ---- plcopen_instances.cpp

/// Configurations, resources, tasks, devices.
void readInstances(Context &context, const Node &instances);

/// A duration of XML (`PT0.05S`) or a number with its unit as a TIME literal; others as they are.
[[nodiscard]] std::string durationText(const std::string &text, const std::string &unit = {});

// ---- plcopen_devices.cpp

/// A drive of the device tree, or a line of the report about another device.
void readDevice(Context &context, const Node &configuration, std::vector<DriveSetup> &drives);
/// Puts all of them on a bus of simulated drives; `task`: of their group, or empty.
void addDrives(Context &context, std::vector<DriveSetup> drives, const std::string &task);

// ---- plcopen_reader.cpp

/// What stands in addData of a project or resource: POUs, types, interfaces, lists, libraries.
void readExtras(Context &context, const Node &node, const std::string &listName);

} // namespace stc::import::plcopen

#endif // STRIDE_COMPILER_IMPORT_PLCOPEN_CONTEXT_HPP
