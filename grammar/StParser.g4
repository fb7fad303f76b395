// Syntax of Structured Text: IEC 61131-3 with the extensions of CoDeSys V2.3 and CODESYS V3.
//
// Written so that one token of lookahead decides every alternative: the generated parser never runs ANTLR's adaptive
// prediction. What makes that possible lies in the scanner: soft keywords and `S=` are told from identifiers there, and
// a LABEL token stands before CASE labels.
//
// The grammar is deliberately wider than the language where one rule serves several purposes (arguments, aggregates,
// parentheses and indices are all `arguments`; an expression may stand as a statement); the AST builder narrows it again
// with better messages than the parser could give. It also narrows operator precedence: `expression` is flat.
//
// The compiler cuts a file into units and parses one after the other, so that a parse tree stays small; sourceFile shows
// how the units belong together. The scanner drops semicolons between units.

parser grammar StParser;

options {
  tokenVocab = StLexer;
  superClass = ParserBase; // with members of the names that generated code uses: ANTLR's are slower
  contextSuperClass = ContextBase;
}

@postinclude {
#include "compiler/syntax/parser_base.hpp"
}

sourceFile : ( declaration | namespaceBlock | usingDirective )* EOF ;

namespaceBlock : namespaceHead ( declaration | namespaceBlock | usingDirective )* END_NAMESPACE ;
declaration    : pou | typeBlock | varSection | configuration ;

// ---- units

headUnit      : pouHead EOF ;
sectionUnit   : varSection EOF ;
typeUnit      : typeBlock EOF ;
bodyUnit      : statements EOF ;
namespaceUnit : namespaceHead EOF ;
usingUnit     : usingDirective EOF ;
resourceUnit  : resourceHead EOF ;
taskUnit      : taskDeclaration EOF ;
instanceUnit  : programInstance EOF ;

// ---- program organisation units

// Methods, properties and actions stand inside of a POU or after it.
pou
  : pouHead usingDirective* ( varSection | pou | accessor )* ( BODY statements pou* )?
    ( END_PROGRAM | END_FUNCTION | END_FUNCTION_BLOCK | END_CLASS | END_INTERFACE | END_METHOD | END_PROPERTY
    | END_ACTION
    )
  ;
accessor : ( GET | SET ) varSection* BODY statements ( END_GET | END_SET ) ;

// The head of every POU and member; the AST builder says which of them may extend, implement or return something.
pouHead
  : ( PROGRAM | FUNCTION | FUNCTION_BLOCK | CLASS | INTERFACE | METHOD | PROPERTY | ACTION ) modifiers path
    extendsClause? implementsClause? ( COLON typeSpec )?
  ;

modifiers        : ( ABSTRACT | FINAL | PUBLIC | PRIVATE | PROTECTED | INTERNAL | OVERRIDE )* ;
extendsClause    : EXTENDS path ( COMMA path )* ;
implementsClause : IMPLEMENTS path ( COMMA path )* ;
path             : IDENT ( DOT IDENT )* ;

namespaceHead  : NAMESPACE modifiers path ;
usingDirective : USING path ( COMMA path )* SEMICOLON ;

// ---- configuration

configuration : CONFIGURATION IDENT ( varSection | resource | taskDeclaration | programInstance )* END_CONFIGURATION ;
resource      : resourceHead ( varSection | taskDeclaration | programInstance )* END_RESOURCE ;
resourceHead  : RESOURCE IDENT ( ON IDENT )? ;

taskDeclaration : TASK IDENT ( LPAREN arguments RPAREN )? SEMICOLON ;
programInstance
  : PROGRAM ( RETAIN | NON_RETAIN )? IDENT ( WITH IDENT )? ( COLON path )? ( LPAREN arguments RPAREN )? SEMICOLON
  ;

// ---- variables

varSection
  : ( VAR | VAR_INPUT | VAR_OUTPUT | VAR_IN_OUT | VAR_TEMP | VAR_STAT | VAR_EXTERNAL | VAR_GLOBAL | VAR_INST )
    qualifiers varDeclaration* END_VAR
  | VAR_CONFIG qualifiers configVariable* END_VAR
  | VAR_ACCESS qualifiers accessVariable* END_VAR
  ;

qualifiers
  : ( CONSTANT | RETAIN | PERSISTENT | NON_RETAIN | PUBLIC | PRIVATE | PROTECTED | INTERNAL | FINAL | ABSTRACT
    | OVERRIDE )*
  ;
varDeclaration : varNames COLON typeSpec ( R_EDGE | F_EDGE )? ( ( ASSIGN | REF_ASSIGN ) initializer )? SEMICOLON+ ;
configVariable : operand ( AT DIRECT )? COLON typeSpec ( ASSIGN initializer )? SEMICOLON+ ;
accessVariable : IDENT COLON operand COLON typeSpec ( READ_ONLY | READ_WRITE )? SEMICOLON+ ;
varNames       : IDENT ( AT DIRECT )? ( COMMA IDENT ( AT DIRECT )? )* | AT DIRECT ;

// V2.3 writes the elements of an array without brackets.
initializer : expression ( COMMA expression )* ;

// ---- types

typeBlock : TYPE typeDeclaration* END_TYPE ;

typeDeclaration
  : modifiers IDENT extendsClause? COLON
    ( structBody SEMICOLON* | typeSpec ( ASSIGN initializer )? SEMICOLON+ )
  ;

structBody : ( STRUCT | UNION ) extendsClause? SEMICOLON* varDeclaration* ( END_STRUCT | END_UNION ) ;

typeSpec
  : ARRAY LBRACKET arrayRange ( COMMA arrayRange )* RBRACKET OF typeSpec
  | ( POINTER | REFERENCE ) TO typeSpec
  | REF_TO typeSpec
  | ( STRING | WSTRING ) ( LPAREN expression RPAREN | LBRACKET expression RBRACKET )?
  | LPAREN typeArgument ( COMMA typeArgument )* RPAREN path?
  | path ( LPAREN ( typeArgument ( COMMA typeArgument )* )? RPAREN | LBRACKET arguments RBRACKET )?
  ;

arrayRange : STAR | expression DOTDOT expression ;

// A subrange `0..10`, an enumerator `a := 1`, an argument for FB_Init.
typeArgument : expression ( DOTDOT expression | ASSIGN expression )? ;

// ---- statements

statements : statement* ;

statement
  : SEMICOLON
  | simpleStatement
  | ifStatement
  | caseStatement
  | forStatement
  | whileStatement
  | repeatStatement
  | tryStatement
  | ( EXIT | CONTINUE ) SEMICOLON
  | RETURN ( LPAREN condition RPAREN )? SEMICOLON
  | JMP IDENT SEMICOLON
  | JUMP_LABEL IDENT COLON
  ;

// Assignments and calls; other expressions are accepted here to be reported with their meaning in mind (`a = 1;`).
simpleStatement
  : operand
    ( ( PLUS | MINUS | STAR | SLASH | POWER | EQUAL | NOT_EQUAL | LESS | LESS_EQUAL | GREATER | GREATER_EQUAL
      | AMPERSAND | AND | OR | XOR | MOD | AND_THEN | OR_ELSE
      ) operand
    )*
    ( ASSIGN expression ( ASSIGN expression )*
    | ( ( SET_ASSIGN | RESET_ASSIGN ) expression )+
    | REF_ASSIGN expression
    )?
    SEMICOLON
  ;

// The `;` after END_IF and the like is an empty statement.
ifStatement
  : IF condition THEN statements ( ELSIF condition THEN statements )* ( ELSE statements )? END_IF
  ;
caseStatement   : CASE condition OF caseBranch* ( ELSE statements )? END_CASE ;
caseBranch      : caseLabels statements ;
caseLabels      : LABEL caseLabel ( COMMA caseLabel )* COLON ;
caseLabel       : expression ( DOTDOT expression )? ;
forStatement    : FOR forControl DO statements END_FOR ;
forControl      : operand ASSIGN expression TO expression ( BY expression )? ;
whileStatement  : WHILE condition DO statements END_WHILE ;
repeatStatement : REPEAT statements UNTIL condition SEMICOLON? END_REPEAT ;

tryStatement
  : TRY statements ( CATCH LPAREN operand? RPAREN statements )? ( FINALLY statements )? END_TRY
  ;

// `:=` is accepted here to be reported as a mistaken `=`.
condition : expression ( ASSIGN expression )? ;

// ---- expressions

// Flat; the AST builder groups by precedence.
expression
  : operand
    ( ( PLUS | MINUS | STAR | SLASH | POWER | EQUAL | NOT_EQUAL | LESS | LESS_EQUAL | GREATER | GREATER_EQUAL
      | AMPERSAND | AND | OR | XOR | MOD | AND_THEN | OR_ELSE
      ) operand
    )*
  ;

operand
  : ( NOT | PLUS | MINUS )*
    ( ( IDENT | INTEGER | REAL | TRUE | FALSE | STRING_LITERAL | WSTRING_LITERAL | TIME_LITERAL | TYPED_LITERAL
      | ENUM_LITERAL | DIRECT
      | LPAREN arguments RPAREN
      | LBRACKET arguments RBRACKET
      )
      ( DOT ( IDENT | INTEGER | DIRECT ) | CARET | LPAREN arguments RPAREN | LBRACKET arguments RBRACKET )*
    | TYPE_ARGUMENT typeSpec
    )
  ;

// Call arguments, indices, the inside of parentheses and the elements of an aggregate. A call may end with a comma.
arguments : ( argument ( COMMA argument? )* )? ;
argument  : expression ( ( ASSIGN | ARROW ) expression? )? ;
