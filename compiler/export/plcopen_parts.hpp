#ifndef STRIDE_COMPILER_EXPORT_PLCOPEN_PARTS_HPP
#define STRIDE_COMPILER_EXPORT_PLCOPEN_PARTS_HPP
// Parts of a PLCopen XML file. Internal to compiler/export.

#include "compiler/export/declaration_texts.hpp"
#include "compiler/project/project.hpp"

#include <pugixml.hpp>
#include <string>
#include <string_view>

namespace stc::exporting {

using Node = pugi::xml_node;

/// The names of `data` elements that CODESYS writes; after this.
inline constexpr std::string_view kCodesys = "http://www.3s-software.com/plcopenxml/";
/// Those of Stride: text that no element can say.
inline constexpr std::string_view kStride = "urn:stride:plcopen:";

/// Writes elements of one project.
class Writer {
public:
  explicit Writer(const Project &project) : project_(project) {}

  // ---- plcopen_writer.cpp

  /// A new `data` of the element's addData, which is made when it is not there.
  static Node addData(Node parent, std::string_view space, std::string_view name,
                      const char *handleUnknown = "implementation");
  /// Text in `<xhtml>`, as the format wants it; characters that XML does not have become blanks.
  static void addXhtml(Node parent, std::string_view text);
  static void addDocumentation(Node parent, std::string_view text);
  static void addPlainDeclaration(Node parent, std::string_view text);
  void addAttributes(Node parent, ast::Attributes attributes) const;
  [[nodiscard]] std::string textOf(Span span) const;
  [[nodiscard]] static std::string pathOf(ast::NamePath path);

  // ---- plcopen_types.cpp

  /// The element of a type, below `parent`.
  void type(Node parent, const ast::TypeExpr *type) const;
  void initialValue(Node parent, const ast::Expr *value) const;
  void variable(Node list, const ast::VarDecl &variable) const;
  /// A TYPE; null: it is a union, which the format does not have (CODESYS: in addData).
  Node dataType(Node dataTypes, Node project, const ast::Decl &decl, const DeclarationText &text,
                bool whole) const;

  // ---- plcopen_pous.cpp

  Node pou(Node pous, const ast::PouDecl &decl, const DeclarationTexts &texts, bool whole) const;
  /// An INTERFACE, in the project's addData.
  Node interface(Node project, const ast::PouDecl &decl, const DeclarationTexts &texts,
                 bool whole) const;
  /// Variables in lists of the same section and qualifiers, in the order of the text.
  void variables(Node interface, std::span<ast::VarDecl *const> variables) const;
  static void setQualifiers(Node list, uint8_t qualifiers);

  // ---- plcopen_chart.cpp

  /// The body and the named transitions of a POU whose body is a chart. False: it is none, or one
  /// that stays text.
  static bool chart(Node pou, std::string_view body);

  // ---- plcopen_tasks.cpp

  /// The tasks, as stride.toml or a CONFIGURATION gives them.
  void tasks(Node resource) const;
  /// A list of global variables, of all its blocks.
  Node globals(Node resource, const std::string &name,
               const std::vector<const ast::GlobalsDecl *> &blocks, const DeclarationTexts &texts,
               bool whole) const;

private:
  void members(Node pou, const ast::PouDecl &decl, const DeclarationTexts &texts) const;
  void method(Node parent, const ast::PouDecl &decl, const DeclarationTexts &texts) const;
  void property(Node parent, const ast::PropertyDecl &decl, const DeclarationTexts &texts) const;
  void accessor(Node property, const char *name, const ast::PouDecl *decl,
                const ast::PropertyDecl &owner, const DeclarationTexts &texts) const;
  void interfaceOf(Node parent, const ast::PouDecl &decl) const;
  bool composite(Node parent, const ast::AggregateExpr &value) const;
  void enumeration(Node parent, const ast::EnumTypeExpr &type) const;

  const Project &project_;
};

/// Without blank lines at the beginning and blanks at the end; lines end with \n. Empty: nothing
/// is there.
[[nodiscard]] std::string trimmedLines(std::string_view text);

} // namespace stc::exporting

#endif // STRIDE_COMPILER_EXPORT_PLCOPEN_PARTS_HPP
