autocmd BufRead,BufNewFile *.st setfiletype st
