// Tokens of Structured Text: IEC 61131-3 with the extensions of CoDeSys V2.3 and CODESYS V3.
//
// This grammar is the vocabulary of StParser.g4 and the reference definition of every token. The compiler reads text
// with a hand-written scanner (compiler/syntax/scanner.cpp) that produces the same tokens; tests compare the two. Where
// a word is a keyword only in its place (the "soft" keywords below, S=, R=, REF=) this lexer always sees the keyword and
// the scanner decides by the neighbouring tokens.
//
// Keywords and identifiers do not distinguish case.

lexer grammar StLexer;

tokens {
  // Inserted by the scanner before each list of CASE labels, so that one token of lookahead tells a label from a
  // statement.
  LABEL,
  // Before `name:` where a JMP may lead.
  JUMP_LABEL,
  // Before a type that is the argument of SIZEOF, __NEW and the like, when it begins with a keyword.
  TYPE_ARGUMENT,
  // Stands between the declarations of a POU and its statements (only where a whole POU is parsed at once).
  BODY
}

// ---- operators (first, so that their token types stay small: the parser tests sets of them as bit masks)

PLUS          : '+' ;
MINUS         : '-' ;
STAR          : '*' ;
SLASH         : '/' ;
POWER         : '**' ;
EQUAL         : '=' ;
NOT_EQUAL     : '<>' ;
LESS          : '<' ;
LESS_EQUAL    : '<=' ;
GREATER       : '>' ;
GREATER_EQUAL : '>=' ;
AMPERSAND     : '&' ;
AND           : A N D ;
OR            : O R ;
XOR           : X O R ;
MOD           : M O D ;
AND_THEN      : A N D '_' T H E N ; // soft: after an operand
OR_ELSE       : O R '_' E L S E ;   // soft: after an operand
NOT           : N O T ;

ASSIGN       : ':=' ;
ARROW        : '=>' ;
SET_ASSIGN   : S '=' ;     // only after a variable
RESET_ASSIGN : R '=' ;     // only after a variable
REF_ASSIGN   : R E F '=' ; // only after a variable

SEMICOLON : ';' ;
COLON     : ':' ;
COMMA     : ',' ;
DOTDOT    : '..' ;
DOT       : '.' ;
LPAREN    : '(' ;
RPAREN    : ')' ;
LBRACKET  : '[' ;
RBRACKET  : ']' ;
CARET     : '^' ;

// ---- keywords

TRUE  : T R U E ;
FALSE : F A L S E ;

IF         : I F ;
THEN       : T H E N ;
ELSIF      : E L S I F ;
ELSE       : E L S E ;
END_IF     : E N D '_' I F ;
CASE       : C A S E ;
OF         : O F ;
END_CASE   : E N D '_' C A S E ;
FOR        : F O R ;
TO         : T O ;
BY         : B Y ;
DO         : D O ;
END_FOR    : E N D '_' F O R ;
WHILE      : W H I L E ;
END_WHILE  : E N D '_' W H I L E ;
REPEAT     : R E P E A T ;
UNTIL      : U N T I L ;
END_REPEAT : E N D '_' R E P E A T ;
EXIT       : E X I T ;
RETURN     : R E T U R N ;
CONTINUE   : C O N T I N U E ; // soft: as a whole statement
TRY        : '__' T R Y ;
CATCH      : '__' C A T C H ;
FINALLY    : '__' F I N A L L Y ;
END_TRY    : '__' E N D T R Y ;

PROGRAM            : P R O G R A M ;
END_PROGRAM        : E N D '_' P R O G R A M ;
FUNCTION           : F U N C T I O N ;
END_FUNCTION       : E N D '_' F U N C T I O N ;
FUNCTION_BLOCK     : F U N C T I O N '_' B L O C K ;
END_FUNCTION_BLOCK : E N D '_' F U N C T I O N '_' B L O C K ;
TYPE               : T Y P E ;
END_TYPE           : E N D '_' T Y P E ;
STRUCT             : S T R U C T ;
END_STRUCT         : E N D '_' S T R U C T ;

VAR          : V A R ;
VAR_INPUT    : V A R '_' I N P U T ;
VAR_OUTPUT   : V A R '_' O U T P U T ;
VAR_IN_OUT   : V A R '_' I N '_' O U T ;
VAR_TEMP     : V A R '_' T E M P ;
VAR_STAT     : V A R '_' S T A T ;
VAR_EXTERNAL : V A R '_' E X T E R N A L ;
VAR_GLOBAL   : V A R '_' G L O B A L ;
VAR_CONFIG   : V A R '_' C O N F I G ;
VAR_ACCESS   : V A R '_' A C C E S S ;
VAR_INST     : V A R '_' I N S T ;
END_VAR      : E N D '_' V A R ;

CONSTANT   : C O N S T A N T ;         // soft: after VAR…
RETAIN     : R E T A I N ;             // soft: after VAR…
PERSISTENT : P E R S I S T E N T ;     // soft: after VAR…
NON_RETAIN : N O N '_' R E T A I N ;   // soft: after VAR…
AT         : A T ;                     // soft: before an address

ARRAY     : A R R A Y ;
STRING    : S T R I N G ;
WSTRING   : W S T R I N G ;
POINTER   : P O I N T E R ;     // soft: before TO
REFERENCE : R E F E R E N C E ; // soft: before TO
REF_TO    : R E F '_' T O ;     // soft: in a type, before another one

EXTENDS    : E X T E N D S ;       // soft: between two names
IMPLEMENTS : I M P L E M E N T S ; // soft: between two names
ABSTRACT   : A B S T R A C T ;     // soft: after the keyword that opens a declaration, as the next six
FINAL      : F I N A L ;
PUBLIC     : P U B L I C ;
PRIVATE    : P R I V A T E ;
PROTECTED  : P R O T E C T E D ;
INTERNAL   : I N T E R N A L ;
OVERRIDE   : O V E R R I D E ;

// ---- keywords of further declarations; those without END_ are soft: at the start of a declaration or statement, in
// front of a name

METHOD            : M E T H O D ;
END_METHOD        : E N D '_' M E T H O D ;
PROPERTY          : P R O P E R T Y ;
END_PROPERTY      : E N D '_' P R O P E R T Y ;
INTERFACE         : I N T E R F A C E ;
END_INTERFACE     : E N D '_' I N T E R F A C E ;
CLASS             : C L A S S ;
END_CLASS         : E N D '_' C L A S S ;
ACTION            : A C T I O N ;
END_ACTION        : E N D '_' A C T I O N ;
ACTIONS           : A C T I O N S ;
END_ACTIONS       : E N D '_' A C T I O N S ;
END_GET           : E N D '_' G E T ;
END_SET           : E N D '_' S E T ;
NAMESPACE         : N A M E S P A C E ;
END_NAMESPACE     : E N D '_' N A M E S P A C E ;
USING             : U S I N G ;
CONFIGURATION     : C O N F I G U R A T I O N ;
END_CONFIGURATION : E N D '_' C O N F I G U R A T I O N ;
END_RESOURCE      : E N D '_' R E S O U R C E ;
UNION             : U N I O N ;
END_UNION         : E N D '_' U N I O N ;
JMP               : J M P ;
STEP              : S T E P ;
INITIAL_STEP      : I N I T I A L '_' S T E P ;
END_STEP          : E N D '_' S T E P ;
TRANSITION        : T R A N S I T I O N ;
END_TRANSITION    : E N D '_' T R A N S I T I O N ;

// ---- words that are keywords only inside of PROPERTY, CONFIGURATION and VAR_ACCESS, and after the type of an input

GET        : G E T ;
SET        : S E T ;
RESOURCE   : R E S O U R C E ;
ON         : O N ;
TASK       : T A S K ;
WITH       : W I T H ;
R_EDGE     : R '_' E D G E ;
F_EDGE     : F '_' E D G E ;
READ_ONLY  : R E A D '_' O N L Y ;
READ_WRITE : R E A D '_' W R I T E ;

// ---- literals

// T#1d2h3m4s5ms, LTIME#1.5us, D#2024-02-29, TOD#12:30:15.5, DT#2024-02-29-12:30:15 and the long forms
TIME_LITERAL
  : ( T | T I M E | L T | L T I M E ) '#' SIGN? ( DIGITS ( '.' DIGITS )? [a-zA-Z]+ '_'? )+
  | ( D | D A T E | L D | L D A T E | T O D | T I M E '_' O F '_' D A Y | L T O D | L T I M E '_' O F '_' D A Y
    | D T | D A T E '_' A N D '_' T I M E | L D T | L D A T E '_' A N D '_' T I M E ) '#' [0-9]+ ( [:.\-] [0-9]+ )*
  ;

// INT#5, BYTE#16#FF, REAL#-1.5, BOOL#TRUE, STRING#'…'
TYPED_LITERAL
  : IDENT '#' SIGN? ( BASED | REAL | DIGITS )
  | B O O L '#' ( TRUE | FALSE )
  | IDENT '#' ( STRING_LITERAL | WSTRING_LITERAL )
  ;

// color#green
ENUM_LITERAL : IDENT '#' IDENT ;

INTEGER : DIGITS | BASED ;
REAL    : DIGITS '.' DIGITS EXPONENT? | DIGITS EXPONENT ;

// The scanner takes one for unclosed whose quote does not come before the end of the statement.
STRING_LITERAL  : '\'' ( '$' . | ~[$'] )* '\'' ;
WSTRING_LITERAL : '"' ( '$' . | ~[$"] )* '"' ;

// %IX0.0, %QW2, %MD4, %I*, and partial access after a dot: %X3
DIRECT : '%' [a-zA-Z]+ ( '*' | [0-9]+ ( '.' [0-9]+ )* ) ;

// Two underscores in a row are an error (except in operators such as __NEW), which the scanner reports.
IDENT : [a-zA-Z_] [a-zA-Z0-9_]* ;

// ---- not seen by the parser

DOC_COMMENT   : '///' ~[\r\n]* -> channel(HIDDEN) ;
LINE_COMMENT  : '//' ~[\r\n]* -> channel(HIDDEN) ;
BLOCK_COMMENT : '/*' .*? '*/' -> channel(HIDDEN) ;
NESTED_COMMENT : '(*' ( NESTED_COMMENT | '(' ~[*] | ~[(*] | '*' ~[)] )*? '*'* '*)' -> channel(HIDDEN) ;
// {attribute 'name' := 'value'}, {external}, …; a quote after a letter or digit begins no text: {info don't}
PRAGMA     : '{' ( [A-Za-z0-9_\u0080-\uFFFF]+ ~[A-Za-z0-9_}\u0080-\uFFFF] | '\'' ~['\r\n]* '\'' | '"' ~["\r\n]* '"' | ~['"}A-Za-z0-9_\u0080-\uFFFF] )* [A-Za-z0-9_\u0080-\uFFFF]* '}'
             -> channel(HIDDEN) ;
WHITESPACE : [ \t\r\n\f\u000B\u001A\u00A0]+ -> channel(HIDDEN) ;

// ---- pieces

fragment DIGITS   : [0-9] ( '_'? [0-9] )* ;
fragment BASED    : [0-9]+ '#' [0-9a-zA-Z] ( '_'? [0-9a-zA-Z] )* ;
fragment EXPONENT : [eE] SIGN? [0-9]+ ;
fragment SIGN     : [+\-] ;
fragment A : [aA] ;
fragment B : [bB] ;
fragment C : [cC] ;
fragment D : [dD] ;
fragment E : [eE] ;
fragment F : [fF] ;
fragment G : [gG] ;
fragment H : [hH] ;
fragment I : [iI] ;
fragment J : [jJ] ;
fragment K : [kK] ;
fragment L : [lL] ;
fragment M : [mM] ;
fragment N : [nN] ;
fragment O : [oO] ;
fragment P : [pP] ;
fragment Q : [qQ] ;
fragment R : [rR] ;
fragment S : [sS] ;
fragment T : [tT] ;
fragment U : [uU] ;
fragment V : [vV] ;
fragment W : [wW] ;
fragment X : [xX] ;
fragment Y : [yY] ;
fragment Z : [zZ] ;
