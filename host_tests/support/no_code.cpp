// A target that others have their precompiled header from needs a source.
