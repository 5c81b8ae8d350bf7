"""Ways to the files of a controller: the scheme of a URL names one, `registry` lists them."""
