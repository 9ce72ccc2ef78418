import fnmatch
import os
import shutil


def copy(recipe, pattern, src, dst):
    copied = []
    for folder, _, files in os.walk(src):
        for name in fnmatch.filter(files, pattern):
            to = os.path.join(dst, os.path.relpath(folder, src), name)
            os.makedirs(os.path.dirname(to), exist_ok=True)
            shutil.copy(os.path.join(folder, name), to)
            copied.append(to)
    return copied
