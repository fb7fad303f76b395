% nothing
