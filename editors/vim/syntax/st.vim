" Structured Text (IEC 61131-3), as Stride reads it. Written by editors/generate.py.
if exists("b:current_syntax")
  finish
endif
syn case ignore

syn keyword stControl BY CASE CONTINUE DO ELSE ELSIF END_CASE END_FOR END_IF END_REPEAT END_WHILE EXIT FOR IF
syn keyword stControl JMP OF REPEAT RETURN THEN TO UNTIL WHILE __CATCH __ENDTRY __FINALLY __TRY
syn keyword stDeclaration END_ACTION END_ACTIONS END_CLASS END_CONFIGURATION END_FUNCTION END_FUNCTION_BLOCK
syn keyword stDeclaration END_GET END_INTERFACE END_METHOD END_NAMESPACE END_PROGRAM END_PROPERTY END_RESOURCE
syn keyword stDeclaration END_SET END_STEP END_STRUCT END_TRANSITION END_TYPE END_UNION END_VAR FUNCTION
syn keyword stDeclaration FUNCTION_BLOCK PROGRAM STRUCT TYPE VAR VAR_ACCESS VAR_CONFIG VAR_EXTERNAL VAR_GLOBAL
syn keyword stDeclaration VAR_INPUT VAR_INST VAR_IN_OUT VAR_OUTPUT VAR_STAT VAR_TEMP
syn keyword stOperatorWord AND AND_THEN MOD NOT OR OR_ELSE XOR
syn keyword stModifier ABSTRACT AT CONSTANT EXTENDS FINAL F_EDGE IMPLEMENTS INTERNAL NON_RETAIN ON OVERRIDE
syn keyword stModifier PERSISTENT PRIVATE PROTECTED PUBLIC READ_ONLY READ_WRITE RETAIN R_EDGE WITH
syn keyword stConstant FALSE TRUE

syn match stType "\<\%(LDATE_AND_TIME\|DATE_AND_TIME\|LTIME_OF_DAY\|TIME_OF_DAY\|REFERENCE\|POINTER\|WSTRING\|REF_TO\|STRING\|ARRAY\|DWORD\|LDATE\|LREAL\|LTIME\|LWORD\|UDINT\|ULINT\|USINT\|WCHAR\|BOOL\|BYTE\|CHAR\|DATE\|DINT\|LINT\|LTOD\|REAL\|SINT\|TIME\|UINT\|WORD\|INT\|LDT\|TOD\|DT\)\>#\@!"

syn match stFunction "\<\%(FROM_LITTLE_ENDIAN\|TO_LITTLE_ENDIAN\|__QUERYINTERFACE\|FROM_BIG_ENDIAN\|__QUERYPOINTER\|TO_BIG_ENDIAN\|ASSERT_FALSE\|IS_VALID_BCD\|__ISVALIDREF\|ASSERT_NEAR\|ASSERT_TRUE\|LOWER_BOUND\|UPPER_BOUND\|__POSITION\|ASSERT_EQ\|ASSERT_GE\|ASSERT_GT\|ASSERT_LE\|ASSERT_LT\|ASSERT_NE\|DIV_LTIME\|MUL_LTIME\|__POUNAME\|DIV_TIME\|IS_VALID\|MUL_TIME\|WREPLACE\|__DELETE\|DIVTIME\|INDEXOF\|MULTIME\|REPLACE\|WCONCAT\|WDELETE\|WINSERT\|XSIZEOF\|BITADR\|CONCAT\|DELETE\|INSERT\|SIZEOF\|WRIGHT\|__XADD\|ATAN2\|LIMIT\|RIGHT\|TRUNC\|WFIND\|WLEFT\|__NEW\|ACOS\|ASIN\|ATAN\|EXPT\|FAIL\|FIND\|LEFT\|MOVE\|SQRT\|WLEN\|WMID\|ABS\|ADD\|ADR\|COS\|DIV\|EXP\|INI\|LEN\|LOG\|MAX\|MID\|MIN\|MUL\|MUX\|REF\|ROL\|ROR\|SEL\|SHL\|SHR\|SIN\|SUB\|TAN\|EQ\|GE\|GT\|LE\|LN\|LT\|NE\)\>\ze\s*("
syn match stFunction "\<\%([A-Za-z]\+_\)\=TO_[A-Za-z]\+\ze\s*("
syn match stDeclaration "^\s*\zs\%(CONFIGURATION\|INITIAL_STEP\|TRANSITION\|INTERFACE\|NAMESPACE\|PROPERTY\|RESOURCE\|ACTIONS\|ACTION\|METHOD\|CLASS\|UNION\|USING\|STEP\|TASK\|GET\|SET\)\>\ze\%(\s*\%(:\|\.\|\[\|(\)\)\@!"
syn match stOperator "\*\*\|<>\|<=\|>=\|=>\|:=\|[-+*/<>=&^]"
syn match stOperator "\<\%(REF\|S\|R\)="
syn match stNumber "\<\%(\h\w*#\)\=[-+]\=\%(\d\+#\x[0-9A-Za-z_]*\|\d[0-9_]*\.\d[0-9_]*\%(e[-+]\=\d\+\)\=\|\d[0-9_]*e[-+]\=\d\+\|\d[0-9_]*\)\>"
syn match stNumber "\<\%(ltime\|time\|lt\|t\)#[-+]\=\%(\d[0-9_]*\%(\.\d[0-9_]*\)\=\%(ms\|us\|ns\|d\|h\|m\|s\)_\=\)\+\|\<l\=\%(date_and_time\|time_of_day\|date\|tod\|dt\|d\)#\d\+\%([-:.]\d\+\)*"
syn match stAddress "%\a\+\%(\*\|\d\+\%(\.\d\+\)*\)"
syn match stEscape contained "\$\%(\x\x\|.\)"
syn region stString start=+'+ end=+'+ oneline contains=stEscape
syn region stString start=+"+ end=+"+ oneline contains=stEscape
syn region stPragma start="{" end="}" contains=stString
syn keyword stTodo contained TODO FIXME XXX
syn region stComment start="(\*" end="\*)" contains=stComment,stTodo
syn region stComment start="/\*" end="\*/" contains=stTodo
syn match stComment "//.*$" contains=stTodo
syn match stDoc "///.*$" contains=stTodo

hi def link stControl Statement
hi def link stDeclaration Structure
hi def link stOperatorWord Operator
hi def link stOperator Operator
hi def link stModifier StorageClass
hi def link stConstant Boolean
hi def link stType Type
hi def link stFunction Function
hi def link stNumber Number
hi def link stAddress Identifier
hi def link stEscape SpecialChar
hi def link stString String
hi def link stPragma PreProc
hi def link stTodo Todo
hi def link stComment Comment
hi def link stDoc SpecialComment

let b:current_syntax = "st"
