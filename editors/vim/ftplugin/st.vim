" What `stride fmt` writes: two blanks a level, comments by //.
if exists("b:did_ftplugin")
  finish
endif
let b:did_ftplugin = 1
setlocal shiftwidth=2 softtabstop=2 expandtab
setlocal comments=:///,:// commentstring=//\ %s
let b:undo_ftplugin = "setlocal shiftwidth< softtabstop< expandtab< comments< commentstring<"
