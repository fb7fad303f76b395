#ifndef STRIDE_COMPILER_IMPORT_UNIT_TEXT_HPP
#define STRIDE_COMPILER_IMPORT_UNIT_TEXT_HPP
// Tools that keep the declaration and the body of a POU apart, and its methods in objects of their
// own (CODESYS V3, TwinCAT 3): one source of it.

#include "compiler/import/model.hpp"

#include <string>
#include <vector>

namespace stc::import {

/// What a unit is, beside what its declaration says.
enum class UnitKind { Pou, Method, Property, Get, Set, Action };

/// A POU or a part of one.
struct Unit {
  UnitKind kind = UnitKind::Pou;
  std::string name;        ///< for actions, whose declaration it makes up
  std::string declaration; ///< without the END_… that closes it
  std::string body;        ///< statements; of an interface's parts empty
  std::string notImported; ///< why the body is left out, for {error}; empty: it is not
  std::vector<Unit> members;
};

/// The unit in one text that the compiler reads: what is declared, statements, parts, END_….
/// `problem` says what hinders it (the declaration does not begin as one); the text is empty then.
[[nodiscard]] std::string textOf(const Unit &unit, std::string &problem);

/// Lines with `{attribute 'TcLinkTo' …}`, which tie variables to the tool's hardware: each is a
/// loss. `line` is that of the text's first line.
void reportLinks(const std::string &file, const std::string &object, std::string_view text,
                 size_t line, Model &model);

} // namespace stc::import

#endif // STRIDE_COMPILER_IMPORT_UNIT_TEXT_HPP
