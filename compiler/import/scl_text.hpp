#ifndef STRIDE_COMPILER_IMPORT_SCL_TEXT_HPP
#define STRIDE_COMPILER_IMPORT_SCL_TEXT_HPP
// Declarations and statements of SCL as ST. Internal to compiler/import.

#include "compiler/import/model.hpp"
#include "compiler/import/scl_tokens.hpp"
#include "compiler/import/scl_views.hpp"

#include <map>
#include <set>
#include <string>
#include <vector>

namespace stc::import {

/// Rewrites the tokens of one block from the place on where it stands.
class SclText {
public:
  SclText(const std::string &file, const std::vector<SclToken> &tokens, size_t at, Model &model)
      : file_(file), tokens_(tokens), at_(at), limit_(tokens.size()), model_(model) {}

  [[nodiscard]] size_t at() const { return at_; }
  /// Nothing from this token on is of the block.
  void setLimit(size_t limit) { limit_ = limit; }
  [[nodiscard]] bool atEnd() const { return at_ >= limit_; }
  [[nodiscard]] const SclToken &now() const { return tokens_[at_]; }
  [[nodiscard]] bool isNow(std::string_view capital) const {
    return !atEnd() && isSclWord(now(), capital);
  }
  void skip() { ++at_; }
  /// Passes blanks and comments; comments are added to `out`.
  void pass(std::string &out);
  /// The next token's name, as it can stand here; empty when it is none.
  [[nodiscard]] std::string takeName();
  /// A type: `Array[0..3] of "x"`, a structure; up to what ends it, which stays.
  void type(std::string &out, const std::string &name);
  /// What holds for the members of a list.
  struct MemberRules {
    std::map<std::string, std::string> *initial = nullptr; ///< values that a data block gives
                                                           ///< them by name; used ones are erased
    bool noValues = false;                                 ///< initial values are dropped
    bool ofBlock = false;                                  ///< variables of a POU: views are kept
  };
  /// Members of a structure or of variables up to `end` (END_VAR, END_STRUCT), which is passed.
  void members(std::string &out, const std::string &owner, std::string_view end,
               const MemberRules &rules);
  /// Statements up to `end`, which is passed. False when the block ends before.
  [[nodiscard]] bool statements(std::string &out, std::string_view end);
  /// A value up to the `;`, which is passed.
  [[nodiscard]] std::string value();
  /// Types of structures that had no name; complete declarations.
  [[nodiscard]] const std::string &hoisted() const { return hoisted_; }
  /// Variables of the block that stand for its views and for dates in its statements, as sections.
  [[nodiscard]] std::string ownSections() const;
  /// Lets the views refer to their variables; the first statements of the block.
  [[nodiscard]] std::string viewStatements() const;
  void setObject(std::string object) { object_ = std::move(object); }
  void leaveOut(size_t line, std::string why);
  void changed(size_t line, std::string what);
  /// A piece as ST: names, constants, comments.
  [[nodiscard]] std::string plain(const SclToken &token);

private:
  [[nodiscard]] std::string literal(const SclToken &token);
  [[nodiscard]] std::string comment(std::string_view text);
  [[nodiscard]] const SclToken *significant(size_t from) const;
  [[nodiscard]] std::string date(const SclToken &token);
  bool view(std::string &out, const std::string &name, size_t nameAt, const std::string &owner);
  [[nodiscard]] bool namesOwn(size_t at) const;
  [[nodiscard]] const std::vector<size_t> &usesOf(const std::string &name);
  bool partView(const std::string &name, const std::string &of, std::string_view as,
                std::string_view structure, std::string_view seen);
  [[nodiscard]] bool isView(const SclToken &token, std::string_view before) const;
  void viewed(std::string &out);
  void structure(std::string &out, const std::string &name);
  void memberValue(std::string &out, const std::string &name, std::string_view end,
                   const MemberRules &rules);
  void typeWord(const SclToken &token);
  void region(std::string &out);
  void statementToken(std::string &out);
  void address(std::string &out);
  void compound(std::string &out);

  const std::string &file_;
  const std::vector<SclToken> &tokens_;
  size_t at_;
  size_t limit_;
  Model &model_;
  std::string object_;
  std::string hoisted_;
  size_t depth_ = 0;
  size_t statement_ = 0; ///< where the statement begins in the text that is made
  bool inStatements_ = false;
  struct View {
    std::string name;
    std::string of;       ///< the variable that is seen as another type
    std::string type;     ///< as which type
    SclViewParts parts{}; ///< of it; none: the view has its size
  };
  std::map<std::string, View> views_;               ///< by their names in lower case
  std::map<std::string, std::vector<size_t>> uses_; ///< tokens by names in lower case
  std::map<std::string, std::string> types_; ///< of the block's variables, by names in lower case
  std::map<std::string, std::string> dates_; ///< values of dates in statements, by their names
  bool closing_ = false;                     ///< a `)` is due before the next `;`
  std::set<std::string> named_;              ///< what has been said about this block
};

} // namespace stc::import

#endif // STRIDE_COMPILER_IMPORT_SCL_TEXT_HPP
