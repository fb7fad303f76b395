#pragma once
// The checker: declarations, types, expressions, statements. Internal to compiler/semantics;
// program.hpp is the door.

#include "compiler/semantics/builtins.hpp"
#include "compiler/semantics/conversions.hpp"
#include "compiler/semantics/program.hpp"
#include "compiler/semantics/storage.hpp"
#include "compiler/semantics/type_table.hpp"

#include <optional>
#include <set>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <vector>

namespace stc {

class Checker {
public:
  Checker(Program &program, const LibraryIndex &index);

  void checkUser(const std::vector<ast::File *> &files);
  void checkLibrary(std::string_view name);

private:
  /// The names of one library or of the project.
  struct Module {
    Library *library = nullptr;
    std::unordered_map<Ident, Symbol *>
        names; ///< POUs, types, variables of lists that need no qualification
    std::unordered_map<Ident, GlobalsSymbol *> lists;
    std::unordered_map<Ident, std::vector<EnumeratorSymbol *>> enumerators;
    std::unordered_map<Ident, NamespaceSymbol *> spaces; ///< outermost namespaces
    std::vector<TypeSymbol *> declaredTypes;             ///< in the order of the text
    std::unordered_set<std::string> loadedFiles;
  };

  /// Where names are looked up.
  struct Scope {
    Module *module = nullptr;
    PouSymbol *pou = nullptr;
    const ast::Decl *home = nullptr; ///< whose NAMESPACE and USING hold; null: the POU's
  };
  class ScopeGuard;

  // modules.cpp
  Module &module(const std::string &name);
  Module &moduleOf(const Symbol *symbol);
  void loadLibraryFile(const LibraryIndex::Entry &entry);
  void declareFile(Module &module, ast::File *file);
  void declareGlobals(Module &module, ast::GlobalsDecl *decl);
  void resolveEnumerations(Module &module);
  void addName(Module &module, Symbol *symbol);
  void checkModule(Module &module);
  /// Declares the blocks and lists read from libraries: an instance that nobody calls has members
  /// and defaults too.
  void declareUsed();
  // containment.cpp
  /// Reports types that hold themselves, and what is nested too deeply or too large; cuts them
  /// there.
  void checkContainment(Module &module);
  /// The levels of types in `type`; `level`: so many hold it on the way to it.
  unsigned checkContained(const Type *type, unsigned level,
                          std::unordered_map<const Type *, unsigned> &depths);
  void checkSize(VarSymbol *variable);
  /// Reports a name that is reached through so many declarations that the stack ends.
  bool isTooDeep(const ast::Name &name);
  /// Looks for what is probably not meant; only in programs without errors.
  void lint(Module &module);

  // shadowing.cpp
  void checkShadowing(Module &module);
  void checkHidden(Module &module, const PouSymbol *pou, const VarSymbol *v);
  void checkHiddenMember(const PouSymbol *method, const VarSymbol *v);
  Diagnostic &reportHidden(const VarSymbol *v, const Symbol *hidden, const std::string &what);
  void checkHiddenLibrary(Module &module);

  // names.cpp
  Symbol *lookup(const ast::Name &name);
  Symbol *lookupInModule(Module &module, Ident id);
  /// Whether names of that file are seen here without the library's name.
  [[nodiscard]] bool isSeenUnqualified(const LibraryIndex::Entry &entry) const;
  Symbol *lookupInLibraries(Ident id);
  /// `Library.Name`
  Symbol *lookupInLibrary(Ident library, Ident id);
  /// A cam table of that name (cam_tables.hpp); null when it is none.
  Symbol *declareCamTable(Ident id);
  EnumeratorSymbol *lookupEnumerator(const ast::Name &name, const Type *expected, bool &ambiguous);
  static EnumeratorSymbol *findEnumerator(const EnumType *type, Ident id);
  VarSymbol *findMember(const Type *type, Ident id);
  std::vector<std::string_view> visibleNames(bool types);
  std::string_view similarName(const ast::Name &name, bool asType);
  std::vector<std::string_view> memberNames(const Type *type);
  bool reportUnqualified(const ast::Name &name, const Type *expected);
  void reportUnknown(const ast::Name &name, bool asType);
  /// Says where else the name exists, or what another language's word is called here.
  bool helpElsewhere(Diagnostic &d, const ast::Name &name, bool asType);
  /// The nearest of the members, or all of them when they are few.
  void helpMembers(Diagnostic &d, const ast::Name &name,
                   const std::vector<std::string_view> &members);
  /// Shows how the called POU is declared.
  void noteSignature(Diagnostic &d, const PouSymbol *pou);

  // namespaces.cpp
  /// The namespace of that path, made when it is new; null for an empty path.
  NamespaceSymbol *declareSpace(Module &module, ast::NamePath path);
  /// The declaration whose NAMESPACE and USING hold here, or null.
  [[nodiscard]] const ast::Decl *home() const;
  /// The namespaces around this place, from inside to outside.
  std::vector<NamespaceSymbol *> spacesHere();
  /// What a USING directive names: a namespace or a library; null: neither.
  Symbol *usedSpace(const ast::NamePath &path);
  Symbol *lookupInSpaces(Ident id);
  Symbol *lookupInUsings(const ast::Name &name);
  /// A name of the project (or library): in the namespaces around, outside of all, by USING.
  Symbol *lookupDeclared(const ast::Name &name);
  /// `A.B.Name`, also `Library.Name`; reports what it does not find.
  Symbol *lookupPath(ast::NamePath path, bool asType);
  /// What `space.name` is, of a namespace or a library; null: nothing.
  Symbol *memberOfSpace(Symbol *space, Ident id);
  /// The same, where the ST names it: reports what is INTERNAL to a namespace.
  Symbol *nameInSpace(Symbol *space, const ast::Name &name);
  /// Whether what is INTERNAL and declared there can be used here.
  bool seesInternals(const Library *library, const NamespaceSymbol *space);
  void checkUsings(const ast::Decl *decl);

  // declarations.cpp
  void resolve(TypeSymbol *symbol);
  /// Makes `type` extend `base`, unless that makes too long a chain.
  void extendStruct(StructType *type, const ast::Name &baseName, const StructType *base);
  void resolveStruct(TypeSymbol *symbol, ast::StructDecl *decl);
  /// The alignment that {attribute 'pack_mode'} gives.
  unsigned packMode(const ast::Attributes &attributes, unsigned otherwise);
  const EnumType *makeEnum(ast::EnumTypeExpr *expr, TypeSymbol *symbol);
  void declare(PouSymbol *pou);
  void declare(GlobalsSymbol *globals);
  const Type *typeOf(VarSymbol *variable);
  VarSymbol *makeVariable(ast::VarDecl *decl, Module &module, PouSymbol *owner);
  void bindExternal(PouSymbol *pou, ast::VarDecl *decl);
  const Type *resolveType(ast::TypeExpr *expr, std::string_view hint);
  const Type *resolveNamed(ast::NamedTypeExpr *expr);
  /// The type is written as BIT, and BIT is not the name of a type of the program.
  bool namesBit(const ast::TypeExpr *expr);
  /// The type of a variable of a structure or block, which may be a BIT.
  const Type *resolveMember(VarSymbol *variable, std::string_view hint);
  const Type *resolveArray(ast::ArrayTypeExpr *expr, std::string_view hint);
  const Type *resolveString(ast::StringTypeExpr *expr);
  const Type *resolveSubrange(ast::SubrangeTypeExpr *expr, std::string_view hint);
  std::optional<std::int64_t> constantInteger(ast::Expr *expr, std::string_view what);

  // locations.cpp
  /// The place a complete address names; reports what names none.
  std::optional<Location> locate(const ast::DirectAddress &address);
  /// Makes the area hold the bytes; false (and reported) when it cannot.
  bool reserve(const ast::DirectAddress &address, std::uint64_t byte, std::uint64_t size);
  const Type *checkDirect(ast::DirectExpr *expr);
  /// Gives a variable with an AT clause its location.
  void placeVariable(VarSymbol *variable);
  bool locateType(VarSymbol *variable, std::uint64_t bytes, bool isBool);
  void reportInputWritten(const ast::Expr *expr, const Location &at);
  const Type *checkBitAddress(ast::CallExpr *expr);
  /// Reports RETAIN and PERSISTENT where there is nothing to keep.
  void checkRetain(const VarSymbol *variable);
  void finishImage();

  // consistent.cpp
  /// Notes the variables with {attribute 'consistent'}, and reports it where it does nothing.
  void checkConsistent(const ast::Decl *decl);
  void checkConsistent(std::span<ast::VarDecl *const> variables);
  void reportConsistent(const ast::Attributes &attributes, const std::string &why);

  // configured.cpp
  /// What an expression of VAR_CONFIG or VAR_ACCESS leads to.
  struct PathTarget {
    StatePath path;
    const Type *type = nullptr;
    VarSymbol *variable = nullptr; ///< the last name; null for a program
  };
  template <class Visit> void visitHeld(const Type *type, Visit &&visit);
  /// A value of the type holds variables declared `AT %I*`.
  bool hasSlots(const Type *type);
  void collectSlots(const Type *type, StatePath &path, std::vector<SlotPlace> &out);
  Symbol *pathRoot(const ast::Name &name, Module &module);
  std::optional<PathTarget> ownVariable(const ast::PouDecl &program, const ast::Name &name,
                                        Module &module);
  /// A variable by its path; `inside`: a program whose own variables can be named without it.
  std::optional<PathTarget> resolvePath(ast::Expr *expr, Module &module,
                                        const ast::PouDecl *inside = nullptr);
  void checkConfigEntry(ast::VarDecl *decl, Module &module, std::vector<SlotPlace> &slots);
  void reportMissingPlaces(const std::vector<SlotPlace> &slots);
  void checkConfigured(Module &module);
  void checkAccesses(Module &module);

  static bool isProgramInstance(const VarSymbol *variable);
  void reportTemplate(const ast::Name &name, const PouSymbol *program);
  /// The instances of programs that a CONFIGURATION makes.
  void resolveInstances(Module &module);

  // initializers.cpp
  void checkInitOf(VarSymbol *variable);
  ast::Expr *checkInit(ast::Expr *init, const Type *type);
  ast::Expr *checkArrayInit(ast::AggregateExpr *init, const ArrayType *type);
  void checkFieldInit(ast::AggregateExpr *init, const Type *type);
  void checkItem(ast::AggregateItem &item, const Type *type);
  /// `n(0)` with a constant n is a repetition, not a call; only the names tell.
  void asRepetition(ast::AggregateItem &item);

  // expressions.cpp
  const Type *check(ast::Expr *expr, const Type *expected = nullptr);
  const Type *checkLiteral(ast::Literal *expr);
  const Type *checkName(ast::NameExpr *expr, const Type *expected);
  const Type *checkMember(ast::MemberExpr *expr);
  /// `expr` whose base has been checked to be of type `base` and is no namespace.
  const Type *checkMemberOf(ast::MemberExpr *expr, const Type *base);
  const Type *checkBit(ast::MemberExpr *expr);
  const Type *checkIndex(ast::IndexExpr *expr);
  const Type *checkDeref(ast::DerefExpr *expr);
  const Type *checkEnumLiteral(ast::EnumLiteralExpr *expr);
  const Type *useSymbol(ast::Expr *expr, Symbol *symbol, const ast::Name &name);
  Symbol *resolveNamespace(ast::Expr *expr);
  /// Checks `expr` and converts it to `type`.
  void checkAs(ast::Expr *expr, const Type *type, std::string_view what);
  void checkCondition(ast::Expr *expr, std::string_view what);
  bool requireVariable(ast::Expr *expr, std::string_view what);
  /// Reports a variable that cannot be referred to because it is misaligned.
  bool requireAligned(const ast::Expr *expr, std::string_view what);
  /// The bit number that a constant gives (`w.cBit`), or nothing.
  bool bitByName(ast::MemberExpr *expr);

  // operators.cpp
  const Type *checkUnary(ast::UnaryExpr *expr, const Type *expected);
  const Type *checkBinary(ast::BinaryExpr *expr, const Type *expected);
  const Type *checkArithmetic(ast::BinaryExpr *expr);
  const Type *checkTimeArithmetic(ast::BinaryExpr *expr);
  const Type *checkComparison(ast::BinaryExpr *expr);
  const Type *checkLogical(ast::BinaryExpr *expr);
  const Type *checkPower(ast::BinaryExpr *expr);
  /// Reports a strict enumeration where a number is needed.
  bool refuseStrict(ast::Expr *expr);
  const Type *operatorError(ast::BinaryExpr *expr);
  const Type *fold(ast::BinaryExpr *expr);
  /// The common type of two operands of number type (constants take the other's type when they
  /// fit), or null.
  const Type *commonOf(ast::Expr *a, ast::Expr *b);

  // conversions (coerce.cpp)
  /// Converts a checked expression to `type`; reports what does not convert.
  void coerce(ast::Expr *expr, const Type *type, std::string_view what);
  void reportConversion(ast::Expr *expr, const Type *from, const Type *to, Conversion conversion,
                        std::string_view what);
  /// Gives an untyped constant a type of its own.
  const Type *settle(ast::Expr *expr);
  void setTarget(ast::Expr *expr, const Type *type);

  // calls.cpp
  const Type *checkCall(ast::CallExpr *expr, bool asStatement);
  void bindArguments(ast::CallExpr *expr, PouSymbol *pou);
  void checkArgument(ast::Argument &argument, VarSymbol *parameter);
  void checkReference(ast::Expr *value, const Type *wanted);
  static bool refersTo(const Type *type, const Type *wanted);
  void checkInOut(ast::Argument &argument, VarSymbol *parameter);
  void checkOutput(ast::Argument &argument, VarSymbol *parameter);
  void reportMissing(ast::CallExpr *expr, PouSymbol *pou,
                     const std::unordered_set<VarSymbol *> &given);
  const Type *notCallable(ast::CallExpr *expr, std::string message);

  // builtin_calls.cpp
  const Type *checkBuiltin(ast::CallExpr *expr, const Type *expected);
  /// Puts named arguments of a standard function at their positions; false when something was
  /// reported.
  bool placeArguments(ast::CallExpr *expr);
  const Type *checkConversionCall(ast::CallExpr *expr, const ConversionName &conversion);
  void concatInPairs(ast::CallExpr *expr);
  const Type *checkStringBuiltin(ast::CallExpr *expr);

  // standard_calls.cpp
  /// ADD, GT, MUL_TIME …: the operator with its rules.
  const Type *checkOperatorCall(ast::CallExpr *expr);
  /// GT(a, b, c …): each in order with the next.
  const Type *checkOrderCall(ast::CallExpr *expr);
  /// IS_VALID, IS_VALID_BCD, TO_BIG_ENDIAN …
  const Type *checkPatternCall(ast::CallExpr *expr);
  /// The argument of TRUNC_Y, BCD_TO_Y, TO_BCD_Y; false when it has been reported.
  bool checkSpecialArgument(ast::CallExpr *expr);
  const Type *commonOfArguments(ast::CallExpr *expr, std::size_t first);
  static const Type *commonBeforeWidening(const ast::CallExpr *expr, std::size_t first);
  bool requireCount(ast::CallExpr *expr, std::size_t least, std::size_t most);
  const Type *argumentError(ast::CallExpr *expr, std::size_t index, std::string_view wanted);
  /// Gives a call whose arguments are all constants its value.
  void foldCall(ast::CallExpr *expr, const Type *result);

  // pointers.cpp
  const Type *resolvePointer(ast::PointerTypeExpr *expr, std::string_view hint);
  const Type *checkPointerArithmetic(ast::BinaryExpr *expr);
  /// Gives the operands of a comparison with a pointer their common type; false: not comparable.
  bool comparePointers(ast::BinaryExpr *expr);
  /// Conversions between pointers and with integers, with their warnings; false: not one of them.
  bool coercePointer(ast::Expr *expr, const Type *type, std::string_view what);
  /// The variable of REFERENCE type that the expression names, or null.
  static VarSymbol *referenceVariable(ast::Expr *expr);
  /// The expression names a REFERENCE (that is followed where its value is meant).
  static bool isReference(ast::Expr *expr);
  void checkReferenceAssign(ast::AssignStmt *stmt);

  // arrays.cpp
  const Type *resolveOpenArray(ast::ArrayTypeExpr *expr, const Type *element);
  static bool fitsOpenArray(const Type *actual, const OpenArrayType *wanted);
  /// Reports an ARRAY[*] where a whole value is needed.
  bool refuseOpenArray(ast::Expr *expr, std::string_view action);
  void checkUnion(const StructType *type);

  // implicit_checks.cpp
  void findImplicitChecks(Module &module);
  bool implicitCheckFits(PouSymbol *pou, std::size_t check);

  // dynamic.cpp
  const Type *checkNew(ast::CallExpr *expr);
  const Type *checkDelete(ast::CallExpr *expr);
  const Type *checkIni(ast::CallExpr *expr);

  // measures.cpp
  const Type *checkSizeof(ast::CallExpr *expr);
  const Type *checkIndexOf(ast::CallExpr *expr);
  const Type *checkBound(ast::CallExpr *expr);
  /// The type that an expression names (`INT`, `Lib.Block`), or null when it is not a type's name.
  const Type *namedType(ast::Expr *expr);

  // classes.cpp
  /// Looks up base and interfaces and makes symbols of the members; declares nothing.
  void link(PouSymbol *pou);
  void makeMembers(PouSymbol *pou);
  PouSymbol *makeMethod(PouSymbol *owner, ast::PouDecl *decl, PropertySymbol *property);
  PouSymbol *lookupBase(ast::NamePath path, bool interface, const PouSymbol *from);
  void declareMembers(PouSymbol *pou, std::vector<VarSymbol *> &variables);
  /// Whether members fit each other, the base and the interfaces.
  void checkClass(PouSymbol *pou);
  void checkNameClashes(PouSymbol *pou);
  void checkMethod(PouSymbol *method);
  void checkInterfaceBases(PouSymbol *pou);
  void checkInterfaces(PouSymbol *pou);
  void checkAbstractMethods(PouSymbol *pou);
  static std::string missingMethods(const PouSymbol *pou);
  static std::string nearestMethod(const PouSymbol *pou, const ast::Name &name);
  static ast::Access memberAccess(const PouSymbol *method);

  // members.cpp
  /// The property that the expression names, or null.
  static PropertySymbol *propertyOf(const ast::Expr *expr);
  static Symbol *lookupInPou(PouSymbol *pou, Ident id);
  Symbol *lookupSelf(const ast::Name &name);
  bool reportSelf(const ast::Name &name);
  void followSelf(ast::Expr *&expr);
  [[nodiscard]] bool insideOf(const PouSymbol *owner) const;
  bool requireAccess(Span span, const Symbol *member, const PouSymbol *owner, ast::Access access);
  const Type *useProperty(ast::Expr *expr, PropertySymbol *property, const ast::Name &name);
  bool rejectProperty(const ast::Expr *expr, std::string_view action);
  /// Checks an expression that is going to be assigned to.
  const Type *checkTarget(ast::Expr *expr);
  PouSymbol *methodOf(ast::Expr *callee, const Type *&base);
  const Type *checkMethodCall(ast::CallExpr *expr, PouSymbol *method);
  void reportNoInterface(ast::Expr *expr, const Type *from, const Type *to);
  bool coerceToInterface(ast::Expr *expr, const Type *type);
  const Type *checkQuery(ast::CallExpr *expr);
  const Type *checkIsValidRef(ast::CallExpr *expr);

  // construct.cpp
  void checkConstruct(VarSymbol *variable);
  void bindConstruct(std::span<ast::Argument> arguments, PouSymbol *pou,
                     const std::vector<VarSymbol *> &inputs, Span span);
  void checkLifecycle(PouSymbol *method);
  void checkAfterInit(PouSymbol *method);

  // statements.cpp
  void checkBody(PouSymbol *pou);
  void checkBlock(ast::Block block);
  void checkStatement(ast::Stmt *stmt);
  ast::CallExpr *bareCall(ast::Expr *expr);
  void checkAssign(ast::AssignStmt *stmt);
  void checkCase(ast::CaseStmt *stmt);
  void checkFor(ast::ForStmt *stmt);

  // jumps.cpp
  /// Binds each JMP of a body to its label.
  void checkJumps(ast::Block body);
  void checkTry(ast::TryStmt *stmt);

  [[nodiscard]] bool keepsErrors() const { return program_.diagnostics.errorCount() < errorLimit_; }
  Diagnostic &report(Code code, Span where, std::string message, std::string label = {}) {
    if (!keepsErrors()) {
      notKept_ = {};
      return notKept_;
    }
    return program_.diagnostics.report(code, where, std::move(message), std::move(label));
  }
  const ConstValue *makeConstant(const ConstValue &value) { return arena_.make<ConstValue>(value); }
  [[nodiscard]] std::string describe(const Symbol *symbol) const;
  void noteDeclaration(Diagnostic &diagnostic, const Symbol *symbol);

  Program &program_;
  std::size_t errorLimit_;        ///< so many errors are kept
  std::size_t namesLookedAt_ = 0; ///< for names that are similar to unknown ones
  Diagnostic notKept_;            ///< takes the others
  Arena &arena_;
  const LibraryIndex &index_;
  TypeTable types_;
  Storage storage_;
  const char *stackEnd_; ///< of the thread that checks
  std::unordered_map<std::string, std::unique_ptr<Module>>
      modules_; ///< by library name; the project is ""
  std::unordered_map<Ident, BuiltinSymbol *> builtins_;
  std::unordered_map<Ident, const Type *> elementary_;
  std::unordered_map<Ident, Symbol *>
      libraryMisses_; ///< results of lookupInLibraries, also the misses
  std::unordered_set<const Library *> wholeLibraries_; ///< all of their files are loaded
  Scope scope_;
  std::set<std::uint64_t> reportedNames_; ///< places of USING and INTERNAL names that were reported
  std::set<std::pair<const PouSymbol *, Ident>> unknown_;     ///< names reported already
  std::set<std::pair<const PouSymbol *, Ident>> throughSelf_; ///< members named `THIS^.x`
  unsigned loopDepth_ = 0;
  bool programTypes_ = false;                ///< the type being resolved may be a PROGRAM
  std::vector<ast::GlobalsDecl *> configs_;  ///< VAR_CONFIG
  std::vector<ast::GlobalsDecl *> accesses_; ///< VAR_ACCESS
  std::unordered_set<Ident> resourceNames_;  ///< of CONFIGURATIONs and RESOURCEs
  std::unordered_map<const Type *, bool> hasSlots_;
  const ast::Expr *assignTarget_ = nullptr;         ///< is checked as the target of an assignment
  const ast::TypeExpr *openArrayAllowed_ = nullptr; ///< the type of the VAR_IN_OUT being resolved
};

/// Sets the scope for the lifetime of the guard.
class Checker::ScopeGuard {
public:
  ScopeGuard(Checker &checker, Scope scope) : checker_(checker), saved_(checker.scope_) {
    checker.scope_ = scope;
  }
  ~ScopeGuard() { checker_.scope_ = saved_; }
  ScopeGuard(const ScopeGuard &) = delete;
  ScopeGuard &operator=(const ScopeGuard &) = delete;

private:
  Checker &checker_;
  Scope saved_;
};

} // namespace stc
