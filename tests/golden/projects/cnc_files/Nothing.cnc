%
(nothing)
