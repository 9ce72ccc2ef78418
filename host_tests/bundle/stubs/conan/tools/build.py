def check_min_cppstd(recipe, standard):
    if int(recipe.settings.get_safe("compiler.cppstd")) < standard:
        raise ValueError("the C++ standard is too old")
