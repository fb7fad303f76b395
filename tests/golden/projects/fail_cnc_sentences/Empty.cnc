% a title only
