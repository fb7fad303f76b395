#pragma once
// Bodies and initial values: statements and expressions of one POU (or of a group of types) as C++.

#include "compiler/codegen/addressed.hpp"
#include "compiler/codegen/analysis.hpp"
#include "compiler/codegen/layout.hpp"
#include "compiler/codegen/loop_locals.hpp"
#include "compiler/codegen/names.hpp"
#include "compiler/codegen/writer.hpp"

#include <functional>
#include <string>
#include <string_view>
#include <unordered_set>
#include <utility>
#include <vector>

namespace stc::codegen {

/// What all files of one run share.
struct Context {
  const Program &program;
  const Library *own; ///< the library (or project) whose files are generated
  Names names;
  Layouts layouts;
  Analysis analysis;
  LoopLocals loopLocals;
  Addressed addressed;

  Context(const Program &p, const Library *library)
      : program(p), own(library), names(p), layouts(p, library), analysis(p), loopLocals(analysis),
        addressed(p, library) {}
};

/// An object of its own in the application's state: a variable list, a program, or the statics of a
/// POU.
struct Root {
  const Symbol *symbol = nullptr;
  bool isStatic = false;
  bool operator==(const Root &) const = default;
};
/// `::st::user::GVL__globals__`
std::string rootType(Names &names, const Root &root);
/// `::st::user::GVL__globals__at__`: the constant that holds its place in the state.
std::string rootPlace(Names &names, const Root &root);
/// `GVL__`, `Path__program`, `F__static`: what it is called in bodies and in the state; with the
/// library's name in front when it is not `own`.
std::string rootName(Names &names, const Root &root, const Library *own);
/// The root in which the path begins.
Root rootOf(const StatePath &path);
/// The type of the variable it leads to.
const Type *typeAt(const StatePath &path);
/// The path as C++, from the state: `Main__program.fb.x`.
std::string statePath(Names &names, const StatePath &path, const Library *own);
/// The statics of a POU that has some.
[[nodiscard]] bool hasStatics(const PouSymbol *pou);

/// Emits code into a writer and remembers what that code needs around it.
class Emitter {
public:
  Emitter(Context &context, const PouSymbol *pou);

  // statements.cpp
  void block(ast::Block block);

  // initializers.cpp
  /// What an input is called in the signature of its POU's definition.
  static std::string inputName(Context &context, const VarSymbol *input);
  /// Brings zeroed memory to the variable's default; `target` is a C++ lvalue.
  void initVariable(std::string_view target, const VarSymbol *variable);
  /// The same for the first of these fields of `owner` (a C++ type), which follow each other in it,
  /// if enough of them are alike; gives how many it has dealt with, perhaps 0.
  std::size_t initRun(std::span<const VarSymbol *const> variables, std::string_view owner);
  /// Gives a local variable its default: `T x = 5;` or `T x{};` and what follows.
  /// Without an initial value of its own it counts as standing at `start`, where the body begins.
  void declareLocal(const VarSymbol *variable, Span start);
  /// The place of an input on the data stack, which begins with what was passed; nothing for
  /// others.
  void declareInput(const VarSymbol *input, Span start);
  /// Gives what VAR_CONFIG says of a variable: its initial value.
  void initConfigured(const SlotPlace &entry);

  // lifecycle.cpp
  /// The inside of exit__ or reinit__ (`what` is fb_exit, fb_reinit) of something that holds the
  /// variables; `base` of a structure is walked by itself, `block` together with its bases.
  void lifecycle(const std::vector<const VarSymbol *> &variables, std::string_view what,
                 const Type *base, const PouSymbol *block);

  /// Goes on with the body of another POU (a method of the same block); gives the one before.
  const PouSymbol *enter(const PouSymbol *pou) { return std::exchange(pou_, pou); }

  [[nodiscard]] Writer &writer() { return w_; }
  [[nodiscard]] Includes &includes() { return includes_; }
  /// Run-time checks are made here: not with --unchecked or {attribute 'no_check'}.
  [[nodiscard]] bool checks() const { return c_.program.settings.checks && !noCheck_; }
  [[nodiscard]] bool usesContext() const { return usesContext_; }
  [[nodiscard]] bool usesBudget() const { return usesBudget_; }
  void needContext() { usesContext_ = true; }
  /// The source files whose names the code needs, as constants fileName().
  [[nodiscard]] std::vector<FileId> takeFiles() { return std::exchange(files_, {}); }
  struct RootUse {
    Root root;
    std::string reference; ///< the local name
  };
  [[nodiscard]] std::vector<RootUse> takeRoots() { return std::exchange(roots_, {}); }
  /// The areas of the process image that the code uses: bits by Area.
  [[nodiscard]] unsigned takeAreas() { return std::exchange(areas_, 0); }
  [[nodiscard]] bool used(const VarSymbol *variable) const { return used_.contains(variable); }
  /// `file__`, the constant with the name of a source file.
  std::string fileName(FileId file);
  static std::string fileConstant(std::size_t index) {
    return index == 0 ? "file__" : "file__" + std::to_string(index + 1);
  }
  /// Hands over what has been written and begins anew; uses and roots are kept.
  [[nodiscard]] Writer takeWriter();
  void forgetUses();

private:
  enum Level : int { // of C++'s operators
    kPostfix = 1,
    kUnary = 2,
    kMultiply = 4,
    kAdd = 5,
    kRelation = 7,
    kEquality = 8,
    kBitAnd = 9,
    kBitXor = 10,
    kBitOr = 11,
    kAnd = 12,
    kOr = 13,
  };
  struct Infix {
    std::string_view op; ///< empty: not written as an operator
    int level = kPostfix;
  };
  struct Loop {
    unsigned id;
    bool isDouble;         ///< two C++ loops, so that `break` leaves only the inner one
    unsigned switches = 0; ///< CASE statements around the place, within the loop
    bool labelled = false; ///< an EXIT jumps behind it
  };
  /// A __TRY with __FINALLY whose statements are being written.
  struct Try {
    unsigned id;
    const ast::TryStmt *stmt;
    std::size_t loops;                     ///< how many loops are around it
    std::vector<const ast::Stmt *> leaves; ///< RETURN, EXIT, JMP … that lead out of it
  };

  /// What has been found before its use, until the scope ends.
  class Found {
  public:
    explicit Found(Emitter &emitter) : emitter_(emitter) {}
    ~Found() {
      for (const ast::Expr *e : places_)
        emitter_.found_.erase(e);
    }
    Found(const Found &) = delete;
    Found &operator=(const Found &) = delete;
    /// From now on `name` is written for the place.
    void set(const ast::Expr *place, std::string name) {
      emitter_.found_.insert_or_assign(place, std::move(name));
      places_.push_back(place);
    }

  private:
    Emitter &emitter_;
    std::vector<const ast::Expr *> places_;
  };

  // expressions.cpp
  /// The value in the expression's own type.
  void raw(const ast::Expr *e);
  /// The value converted to Expr::target, to be stored in (or passed as) that type.
  void value(const ast::Expr *e);
  void valueAs(const ast::Expr *e, const Type *type);
  /// The value as an operand of arithmetic on `type`; `other` is the second operand or null.
  void operand(const ast::Expr *e, const Type *type, const ast::Expr *other, bool comparison);
  /// A condition: value() in parentheses is the caller's.
  void condition(const ast::Expr *e) { value(e); }
  /// A string of whatever length, for the runtime's string functions.
  void text(const ast::Expr *e);
  /// A variable (or element, field, bit base …) that can be assigned to.
  void place(const ast::Expr *e);
  void placeValue(std::size_t start, const Type *type, const PouSymbol *from);
  [[nodiscard]] std::string placeText(const ast::Expr *e);
  /// The place as something to be assigned to: `x`, or `::stride::shared(x)` when several tasks use
  /// it.
  [[nodiscard]] std::string writableText(const ast::Expr *e);
  /// Several tasks use the place: it is read and written atomically.
  [[nodiscard]] bool isShared(const ast::Expr *e) const { return c_.program.sharing.holds(e); }
  /// The same of a member of an instance.
  [[nodiscard]] bool isShared(const VarSymbol *member) const {
    return c_.program.sharing.variables.contains(member);
  }
  /// The descriptor that a VAR_IN_OUT of type ARRAY[*] is bound to.
  void openArray(const ast::Expr *e, const OpenArrayType *wanted);
  /// A pointer to it; null references stay null.
  void address(const ast::Expr *e);
  void variable(const VarSymbol *v, Span span);
  void field(const VarSymbol *v);
  /// The slot of an in-out or a reference itself.
  void slot(const ast::Expr *e);
  [[nodiscard]] static const VarSymbol *indirectVariable(const ast::Expr *e);
  void member(const ast::MemberExpr *e, bool slotOnly);
  void slotOf(const ast::MemberExpr *e);
  void memberEnd(const ast::MemberExpr *e, bool indirect);
  void basePath(const Type *base, const VarSymbol *field);
  /// A field of the block whose code is written, maybe one of its bases'.
  void ownField(const VarSymbol *v);
  /// Follows the reference that has been written since `start`.
  void followReference(std::size_t start, const Type *pointee, Span span);
  [[nodiscard]] int level(const ast::Expr *e) const;
  [[nodiscard]] static const ast::Expr *shown(const ast::Expr *e);

  // elements.cpp
  void index(const ast::IndexExpr *e, bool slotOnly);
  void arrayElement(const ArrayType *array, const ast::Expr *i);
  void openElement(std::string base, const OpenArrayType *array, const ast::Expr *i,
                   bool takesBase);
  void pointedElement(std::string base, const Type *type, const ast::Expr *i, bool takesBase);
  std::string openBase(const std::string &base, const Type *type);

  // places.cpp
  /// The base of an area of the process image.
  std::string_view area(Area area);
  /// A variable in the process image; `slot` writes what holds its place.
  template <class Slot> void located(const Location &at, const Type *type, Slot &&slot);
  /// The value of a bit or part (isBitPlace).
  void bitValue(const ast::Expr *e);
  /// Stores what `value` writes in it.
  template <class Value> void bitStore(const ast::Expr *e, Value &&value);
  /// `Bit(image__m[3], 5`: the end of the runtime function's name and the first arguments.
  void bitAccess(const ast::Expr *e, bool writes);
  /// The variable that a bit or part belongs to.
  [[nodiscard]] static const ast::Expr *bitOwner(const ast::Expr *e);
  void initLocated(std::string_view target, const VarSymbol *variable);

  // operators.cpp
  void unary(const ast::UnaryExpr *e);
  void binary(const ast::BinaryExpr *e);
  [[nodiscard]] Infix infix(const ast::BinaryExpr *e) const;
  [[nodiscard]] static bool parenthesize(int child, const Infix &parent, bool right,
                                         std::string_view childOp);
  [[nodiscard]] bool implicitOperand(const ast::Expr *e, const Type *type, const ast::Expr *other,
                                     bool comparison) const;
  void infixOperand(const ast::BinaryExpr *e, const Infix &op, const ast::Expr *side);
  void ordered(const ast::BinaryExpr *e);
  template <class Left, class Right>
  void special(const ast::BinaryExpr *e, Left &&left, Right &&right);
  template <class Left, class Right>
  void pointerArithmetic(const ast::BinaryExpr *e, Left &&left, Right &&right);
  template <class Left, class Right>
  void timeArithmetic(const ast::BinaryExpr *e, Left &&left, Right &&right);

  // conversions.cpp
  void literal(const ConstValue &constant, const Type *from, const Type *to,
               const Symbol *symbol = nullptr);
  void number(std::int64_t value, const Type *type);
  void real(double value, const Type *type);
  void quoted(const ConstValue &constant, bool wide);
  void exactString(const ConstValue &constant, const Type *type);
  /// How a value of `from` becomes one of `to`; `inner` writes the value.
  template <class Inner> void converted(const Type *from, const Type *to, Span span, Inner &&inner);
  [[nodiscard]] bool implicitStore(const Type *from, const Type *to) const;
  void convertedText(std::string_view code, const Type *from, const Type *to, Span span);
  void convertedExpr(const ast::Expr *e, const Type *from, const Type *to);

  // calls.cpp
  void functionCall(const ast::CallExpr *e, bool asStatement);
  /// What is written so that arguments are evaluated in their order.
  struct CallOrder {
    unsigned effects = 0;    ///< of all arguments
    bool statements = false; ///< the call takes more than a C++ expression
    bool arguments = false;  ///< their order shows
    bool object = false;     ///< the instance must be found before them
  };
  [[nodiscard]] CallOrder callOrder(const ast::CallExpr *e);
  [[nodiscard]] unsigned argumentEffects(const ast::Argument &a);
  std::string takeArgument(Found &found, const ast::Argument &a, const CallOrder &order);
  void argument(const ast::Argument &a);
  void passToInstance(const ast::Argument &a, const std::string &field);
  void functionArguments(const ast::CallExpr *e, const std::vector<std::string> &names);
  void defaultArgument(const VarSymbol *parameter);
  void instanceCall(const ast::CallExpr *e, Span span);
  void outputTo(const ast::Expr *target, std::string_view source, const Type *sourceType,
                Span span);

  // methods.cpp
  void self(const SelfSymbol *symbol);
  [[nodiscard]] static bool isExact(const ast::Expr *place);
  void typeIdOf(const ast::Expr *instance);
  void placeAs(const ast::Expr *e, const Type *type);
  void addressAs(const ast::Expr *e, const Type *type);
  void methodPrefix(const ast::Expr *object, const PouSymbol *method, Span span);
  void interfaceOf(const ast::Expr *object, Span span);
  [[nodiscard]] static const ast::Expr *objectOf(const ast::CallExpr *e);
  void propertyGet(const ast::Expr *instance, const PropertySymbol *property, Span span);
  [[nodiscard]] static const PouSymbol *accessor(const PropertySymbol *property, bool get);
  void propertySet(const ast::Expr *target, const std::function<void()> &writeValue);
  void query(const ast::CallExpr *e);

  // lifecycle.cpp
  void eachInstance(std::string_view target, const Type *type,
                    const std::function<void(std::string_view)> &each);
  void callInit(std::string_view target, const PouSymbol *block,
                std::span<const ast::Argument> arguments);
  void construct(std::string_view target, const VarSymbol *variable);
  void constructPlain(std::string_view target, const Type *type);
  void afterInit(std::string_view target, const Type *type);
  void lifecycleOf(std::string_view target, const Type *type, std::string_view what);
  void exitAtEnd(const VarSymbol *variable);
  void aggregateValue(const Type *type, const ast::Expr *init);
  /// `T name{}; `: a temporary of zeroed memory.
  void declareTemporary(const Type *type, std::string_view name, bool onDataStack);
  /// Inline statements that bring `target` to a default, gathered on one line.
  void inlineStatements(const std::function<void(Emitter &)> &write);

  // builtin_calls.cpp
  void builtin(const ast::CallExpr *e);
  bool selectedOnly(const ast::CallExpr *e);
  void orderedBuiltin(const ast::CallExpr *e);
  std::vector<std::string> takeArguments(const ast::CallExpr *e);
  void builtinPlain(const ast::CallExpr *e, const std::vector<std::string> *names);
  [[nodiscard]] bool ordersArguments(const ast::CallExpr *e);
  bool stringInto(std::string_view target, const ast::Expr *value);
  void builtinArgument(const ast::CallExpr *e, std::size_t i, const std::vector<std::string> *names,
                       bool anyText);

  // instances.cpp
  /// What is done to the values of a type, as the name of a local function for each.
  using HeldFunctions = std::unordered_map<const Type *, std::string>;
  template <class Statement>
  void eachElement(const std::string &target, const Type *type, Statement &&statement);
  void unbind(const std::string &target, const Type *type);
  [[nodiscard]] std::string fieldPath(const Type *type, const VarSymbol *field);
  void newObject(const ast::CallExpr *e);
  void deleteObject(const ast::CallExpr *e);
  void copyOf(const ast::Expr *e, const Type *type);
  void reinitialise(const ast::CallExpr *e);
  void initialValues(std::string_view target, const Type *type, const VarSymbol *declared,
                     bool here);
  void initLine(const std::string &text);
  void callForBoth(const HeldFunctions &functions, const std::string &it, const std::string &was,
                   const Type *type);
  void keepValues(const std::string &target, const std::string &old, const Type *type,
                  const std::string &all);

  // assignments.cpp
  /// Writes `auto &to = a[i]; ` where finding the place takes more than its name; until `found`
  /// ends, `to` stands for it. With `always` also where the order does not show, for brevity.
  void findPlace(Found &found, const ast::Expr *place, bool always = false);
  /// The same of the target of an assignment: of a property that is set, its object is found.
  void findTarget(Found &found, const ast::Expr *target);
  /// The same of the instance, or the (checked) interface, whose method is called.
  void findObject(Found &found, const ast::Expr *object);
  [[nodiscard]] bool isBlockValue(const ast::Expr *e) const;
  void assign(const ast::AssignStmt *s);
  void assignValue(const ast::AssignStmt *s);
  void assignReference(const ast::AssignStmt *s);
  void setOrReset(const ast::AssignStmt *s);
  void store(const ast::Expr *target, const ast::Expr *value);
  void storeTo(std::string_view target, const Type *type, const ast::Expr *value);

  // statements.cpp
  void statement(const ast::Stmt *s);
  void callStatement(const ast::CallStmt *s);
  void ifStatement(const ast::IfStmt *s);
  void caseStatement(const ast::CaseStmt *s);
  void caseSwitch(const ast::CaseStmt *s);
  void caseChain(const ast::CaseStmt *s);

  // loops.cpp
  void loop(const ast::Stmt *s);
  void loopStatement(const ast::Stmt *s);
  void forStatement(const ast::ForStmt *s);
  void countedLoop(const ast::ForStmt *s, const std::string &variable, std::int64_t step);
  void refillLoop(std::string_view run, std::string_view first, Span span);
  void loopBody(ast::Block body, bool isDouble);

  // jumps.cpp
  void jump(const ast::JumpStmt *s);
  void label(const ast::LabelStmt *s);
  void tryStatement(const ast::TryStmt *s);
  void catchAll(unsigned id);
  /// A statement that leaves the innermost __TRY with __FINALLY goes there first; false: it does
  /// not leave one.
  bool leaveTry(const ast::Stmt *s);

  void writtenDefault(std::string_view target, const Type *type, const Written &written);
  void typeDefault(std::string_view target, const Type *type);
  void defaultStatement(std::string_view target, const Type *type);
  void initValue(std::string_view target, const Type *type, const ast::Expr *init);
  std::uint64_t arrayValues(std::string_view target, const ArrayType *type,
                            std::span<ast::AggregateItem> items, const std::string &base,
                            std::uint64_t at);
  bool constantTable(std::string_view target, const ArrayType *type,
                     const ast::AggregateExpr *init);
  /// A constant inside of an initial value: where, and as what.
  struct Leaf {
    std::string path;
    const Type *type;
    const ast::Expr *value;
  };
  bool constantLeaves(const Type *type, const ast::Expr *init, const std::string &path,
                      std::vector<Leaf> &leaves);
  bool constantColumns(std::string_view target, const ArrayType *type,
                       const ast::AggregateExpr *init);

  // initializer_runs.cpp
  std::vector<std::vector<Leaf>> similarValues(std::span<const VarSymbol *const> variables);
  std::string columnOf(const std::vector<std::vector<Leaf>> &rows, std::size_t column);
  /// A long list of addresses of global variables: a table of their places.
  bool addressTable(std::string_view target, const ArrayType *type, const ast::AggregateExpr *init);

  // Helpers.
  /// Begins a statement (or a later part of one) that stands at `span`.
  void begin(Span span);
  /// Goes on with the statement at `span`: on the same line if it is the same line of the ST.
  void next(Span span);
  void end() { w_.endLine(); }
  void open() { w_.indent(); }
  void close() { w_.outdent(); }
  std::string_view ctx() {
    usesContext_ = true;
    return context_;
  }
  /// `file__, 12, 3` of a check.
  void position(Span span);
  /// `ctx__, file__, 12, 3`-style arguments end with this.
  std::string_view root(const Root &root);
  std::string temporary(std::string_view stem);
  std::string_view type(const Type *type) {
    includes_.complete(type);
    return c_.names.type(type);
  }
  /// The project's own function for the check, if it has one that is to be called here.
  [[nodiscard]] const PouSymbol *ownCheck(ImplicitCheck check);
  /// Writes the begin of a call of the project's own check; false: there is none.
  bool openRangeCheck(const SubrangeType *range);
  bool openDivisorCheck(const ast::BinaryExpr *e);
  /// An index on its way into `array`, through CheckBounds.
  void checkedIndex(const ast::Expr *index, const ArrayType *array);
  /// A pointer on its way to being followed, through CheckPointer.
  void checkedPointer(const ast::Expr *pointer);
  [[nodiscard]] unsigned effects(const ast::Expr *e) { return c_.analysis.effects(e); }

  Context &c_;
  const PouSymbol *pou_;
  Writer w_;
  Includes includes_;
  bool noCheck_ = false; ///< {attribute 'no_check'}
  bool isCheck_ = false; ///< the body of a check: no check calls itself
  std::unordered_map<const ast::Expr *, std::string> found_; ///< see Found
  bool writing_ = false;                                     ///< the place is about to be written
  bool usesContext_ = false;
  bool usesBudget_ = false;
  std::vector<FileId> files_;
  std::vector<RootUse> roots_;
  unsigned areas_ = 0;
  std::unordered_set<const VarSymbol *> used_;
  const VarSymbol *lastUsed_ = nullptr;
  std::vector<Loop> loops_;
  std::vector<const VarSymbol *> loopLocals_; ///< kept in C++ locals just now
  std::vector<Try> tries_;
  static constexpr std::string_view kContext = "ctx__";
  std::string context_{kContext}; ///< what stands for the context: a loop's own where it has locals
  unsigned next_ = 0;
  std::uint32_t currentLine_ = 0; ///< of the ST, for next()
  Span initSpan_;                 ///< of the variable being initialised
  bool zeroed_ = true;            ///< its memory is zero: it has no default that a zero replaces
};

} // namespace stc::codegen

#include "compiler/codegen/emitter_templates.hpp"
