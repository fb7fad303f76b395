#ifndef STRIDE_COMPILER_SYNTAX_FILE_PARSER_HPP
#define STRIDE_COMPILER_SYNTAX_FILE_PARSER_HPP
// Cuts a file into units, parses one after the other and puts the results together. Internal to
// compiler/syntax.

#include "compiler/syntax/ast_builder.hpp"
#include "compiler/syntax/scanner.hpp"
#include "compiler/syntax/unit_parser.hpp"

#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace stc {

struct Instruction; // instruction_list.hpp
struct Chart;       // chart.hpp
struct ChartAction;
struct ChartStep;
struct ChartTransition;

class FileParser {
public:
  FileParser(const SourceFile &file, Interner &interner, Arena &arena, Diagnostics &diagnostics,
             const ParseOptions *options);

  ast::File *run();

private:
  /// A POU that may still get members from after its end.
  struct OpenPou {
    ast::PouDecl *node = nullptr;
    std::vector<ast::PouDecl *> methods;
    std::vector<ast::PouDecl *> actions;
    std::vector<ast::PropertyDecl *> properties;
  };
  /// What stands between a head and its END_….
  struct Content {
    std::vector<ast::VarDecl *> variables;
    std::vector<ast::Stmt *> statements;
    std::unique_ptr<Chart> chart; ///< null: the body is no chart
    Content();
    ~Content();
  };
  /// Where `head` ended up.
  struct Head {
    ast::PouDecl *node = nullptr; ///< null: it has no name
    ast::NamePath owner;          ///< `Fb` of `METHOD Fb.m`
    Token keyword;
    Span span;
  };
  /// An END_… that may be missing if the end of the file closes everything.
  struct MissingEnd {
    uint16_t wanted;
    Span head;
    Span found;
  };
  struct OpenNamespace {
    size_t names;  ///< how many names it adds
    size_t usings; ///< how many USING directives held before it
    Span head;
  };

  // Reading tokens. `now_` is the next token to take, `ahead_` the one after it.
  void advance();
  void take();
  [[nodiscard]] Span span(const Token &token) const { return builder_.span(token); }
  [[nodiscard]] bool isNow(std::string_view lower) const;
  [[nodiscard]] bool startsDeclaration() const;
  [[nodiscard]] bool endsUnit() const;
  [[nodiscard]] bool startsSection() const;
  [[nodiscard]] bool startsAccessor() const;
  void finishUnit();

  /// Reports a file that is not read at all.
  bool refuses();
  /// Whatever may stand outside of everything, once.
  void declaration();
  void giveMembers(OpenPou &open);
  void findMemberNames();
  [[nodiscard]] std::vector<std::string_view> membersOf(const ast::PouDecl *node);

  // Program units and their members.
  /// The END_… of a keyword; 0: it has none.
  static uint16_t endOf(uint16_t keyword);
  /// "a METHOD", "an ACTION"
  static std::string article(uint16_t keyword);
  void pou();
  Head head();
  bool memberAfterComma();
  /// Whether generic constants stand in it, which has been reported.
  bool readHead(std::vector<Token> &usings);
  bool genericConstants();
  void readHeadType();
  void content(Content &out, OpenPou *members);
  /// Takes the END_… of `head`; says so when it is another one or missing. True: the end of the
  /// file closes it.
  bool close(uint16_t wanted, const Head &head, Span &endSpan);
  void reportMissingEnds();
  void member(OpenPou *owner);
  void method(OpenPou *owner);
  void property(OpenPou *owner);
  ast::PropertyDecl *propertyNode(const Head &head);
  void addAccessor(ast::PropertyDecl *node);
  void strayInProperty(bool report);
  void emptyAccessors(ast::PropertyDecl *node);
  void accessorAccess(ast::Access &access);
  ast::PouDecl *accessor(ast::PropertyDecl *property, bool isSet);
  void lateMember();
  OpenPou *ownerOf(const Head &head, OpenPou *enclosing, ast::Decl *member);
  void finishBody(ast::PouDecl *node, Content &content);
  // Instruction lists.
  bool instructionList(Content &out);
  [[nodiscard]] size_t afterBlanks(size_t at, bool inLine) const;
  void readInstruction(std::vector<Instruction> &list);
  std::string readOperator(std::vector<Token> &line);
  void readOperands(std::vector<Token> &line, bool nests);
  bool understand(Instruction &one, const std::string &word, std::vector<Token> &line);
  bool takeOperands(Instruction &one, const std::vector<Token> &rest);
  bool wrongOperands(const Instruction &one, Span where, const char *what);
  ast::Expr *instructionOperand(const std::vector<Token> &tokens);

  // Sequential function charts.
  [[nodiscard]] bool startsRanked() const;
  [[nodiscard]] bool startsAfterHead() const;
  [[nodiscard]] bool startsChart(bool begun) const;
  void chart(std::unique_ptr<Chart> &out);
  void finishChart(const ast::PouDecl *node, Content &content);
  bool chartToken(uint16_t type);
  void chartError(const std::string &expected);
  void chartError(const std::string &expected, const Token &found);
  void skipChartPart(uint16_t end);
  ast::Expr *chartExpression(const Token &target, Token sign, bool (*ends)(uint16_t));
  bool chartSteps(std::vector<ast::Name> &out, Token &last);
  bool chartTimes(ChartAction &action, const Token &target);
  bool chartQualifier(ChartAction &action, const Token &target);
  bool chartAction(ChartStep &step);
  bool chartStepTimes(ChartStep &step);
  void chartStep(Chart &chart);
  bool chartPriority(ChartTransition &out);
  bool chartTransition(ChartTransition &out);
  bool chartInstructions(ChartTransition &out);

  /// How deep a declaration is nested: brackets, and ARRAY OF, POINTER TO before a type.
  struct Nesting {
    unsigned brackets = 0;
    unsigned types = 0;
    void count(uint16_t type);
    [[nodiscard]] bool isTooDeep() const;
  };
  /// Reports that the declaration which begins at `start` of the unit is nested too deeply, and
  /// leaves it out; `end` closes what it stands in.
  void leaveOut(size_t start, uint16_t end);
  /// Closes what the unit has of a long block, as if `end` stood here.
  void closeUnit(uint16_t end);

  // Other parts of a file.
  void sections(std::vector<ast::VarDecl *> &out);
  [[nodiscard]] bool endsSection(size_t start) const;
  void markAccess();
  void markEdge();
  void types();
  void body(std::vector<ast::Stmt *> &out);
  void readStatements();
  [[nodiscard]] inline bool endsStatements() const;
  inline void nest();
  void leaveOutDeclaration();
  void addBrackets();
  void dropStatement();
  bool markLabel();
  [[nodiscard]] bool isElementaryType(const Token &token) const;
  [[nodiscard]] bool sectionIsClosed() const;
  [[nodiscard]] bool startsStatementInSection() const;
  void markTypeArgument();
  [[nodiscard]] bool isJumpTarget(const Token &name);
  /// VAR_GLOBAL, VAR_CONFIG or VAR_ACCESS; `program`: around the latter.
  void globals(const ast::PouDecl *program = nullptr);
  void outside();
  void namespaceHead();
  void namespaceEnd();
  void usingDirective(std::vector<ast::NamePath> &out);
  void configuration();
  void resource(std::vector<ast::ResourceDecl> &out);
  /// TASK, PROGRAM or VAR…; false: none of them.
  bool resourcePart(std::vector<ast::TaskDecl> &tasks,
                    std::vector<ast::ProgramInstanceDecl> &programs);
  bool strayPart(const char *end);
  void readToSemicolon();

  /// Adds a declaration of the file, with the namespace and the USING directives around it.
  void add(ast::Decl *node);

  /// Runs the rule over the unit; a second time, with reports, when it has an error.
  template <class Context> Context *parseUnit(Context *(Grammar::*rule)());

  const SourceFile &file_;
  Arena &arena_;
  Diagnostics &diagnostics_;
  Conditions conditions_;
  Scanner scanner_;
  UnitStream stream_;
  UnitParser parser_;
  AstBuilder builder_;
  ReportStrategy report_;

  Token now_;
  Token ahead_;
  std::vector<Token> unit_;
  bool sawExternal_ = false; ///< `{external}` since the current POU or method began
  Span externalSpan_;
  bool sawInstructions_ = false; ///< some body of the file is an instruction list
  bool sawChart_ = false;        ///< some body of the file is a chart
  bool chartFailed_ = false;     ///< the current chart has an error of syntax
  std::vector<ast::Decl *> declarations_;
  std::deque<OpenPou> pous_;
  std::vector<ast::StrayMember> strays_;
  /// Of members by the name of their POU in lower case, as charts need it; empty: not looked for.
  std::multimap<std::string, std::string_view> memberNames_;
  unsigned units_ = 0;            ///< POUs and members outside of them so far
  std::vector<uint16_t> closers_; ///< END_… of what is open, from outside to inside
  std::vector<MissingEnd> missing_;
  bool inProperty_ = false; ///< GET and SET open an accessor
  std::vector<ast::Name> space_;
  std::vector<OpenNamespace> namespaces_;
  std::vector<ast::NamePath> usings_;
  ast::NamePath spaceNow_;                           ///< space_ in the arena
  std::span<ast::NamePath> usingsNow_;               ///< usings_ in the arena
  std::optional<std::set<std::string>> jumpTargets_; ///< names after JMP in this file

  // While reading a unit.
  std::vector<uint16_t> blocks_; ///< open IF, CASE, …
  unsigned brackets_ = 0;
  size_t boundary_ = 0;        ///< index in unit_ of the token after the last `;`, THEN, `:` …
  size_t statement_ = 0;       ///< index in unit_ where the current outermost statement begins
  bool reportedDepth_ = false; ///< in this POU
};

template <class Context> Context *FileParser::parseUnit(Context *(Grammar::*rule)()) {
  finishUnit();
  parser_.begin(nullptr);
  try {
    return (parser_.*rule)();
  } catch (antlr4::ParseCancellationException &) {
    parser_.begin(&report_);
  }
  try {
    return (parser_.*rule)();
  } catch (antlr4::ParseCancellationException &) { // too many errors
    return nullptr;
  }
}

} // namespace stc

#endif // STRIDE_COMPILER_SYNTAX_FILE_PARSER_HPP
