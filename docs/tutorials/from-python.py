# %% [markdown]
# # From Python
# %%
1 + 1
